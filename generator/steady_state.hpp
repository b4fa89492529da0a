// SPDX-License-Identifier: GPL-3.0-or-later
// functional = "average": equations in a steady state, and which quantities are averaged over its operating points.
#pragma once
#include <optional>
#include <set>
#include <vector>

#include "generator/equation.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// The equation without the terms that hold a derivative, which is zero in a steady state. Complains about kappa, several rows, a perturbation, a
/// derivative inside a function or in a denominator, and where nothing is left.
std::optional<equation::OperatorForm> in_steady_state(const model::Model& model, const model::Equation& equation, equation::OperatorForm form, Diagnostics& diagnostics);

/// What is averaged: the signals that the rows use, and those with a tolerance, in the order of the model.
struct SteadySignals {
    plan::SteadyState state;
    std::vector<int> index;          ///< of the averaged quantities, by the model's signals; -1: not averaged
    std::set<int> inputs;            ///< the signals that have to be fed
};
/// used: signals of the rows. Complains where `stretches` names no signal.
std::optional<SteadySignals> steady_signals(const model::Model& model, const std::set<int>& used, Diagnostics& diagnostics);

/// The signals that have to be measured for these: computed ones by what their formulas are made of.
std::set<int> measured(const model::Model& model, const std::set<int>& signals);

}  // namespace algest::generator
