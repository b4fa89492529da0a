// SPDX-License-Identifier: GPL-3.0-or-later
// Units of formulas: every sum adds like to like, every function gets a pure number.
#pragma once
#include "generator/diagnostics.hpp"
#include "generator/formula.hpp"
#include "generator/units.hpp"

namespace algest::model {

struct Model;
struct Equation;
struct Feedback;

/// Complains where the sides or the terms of an equation differ in dimension, or in scale (mA added to A). A quantity
/// without a unit makes what it multiplies unknown, and unknown fits everything.
void check_dimension(const Model& model, const Equation& equation, Diagnostics& diagnostics);

/// Warns where a control law does not have the unit of its signal: a gain in it may well be a bare number.
void check_dimension(const Model& model, const Feedback& feedback, Diagnostics& diagnostics);

/// The unit of both sides; unknown if it cannot be told.
units::Unit unit_of_equation(const Model& model, const Equation& equation);

}  // namespace algest::model
