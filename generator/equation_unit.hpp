// SPDX-License-Identifier: GPL-3.0-or-later
// The unit of an equation as its own terms spell it.
#pragma once
#include <string>

#include "generator/model.hpp"

namespace algest::model {

/// In the units that the model gives to what stands in it: cm^3/s where a flow in cm^3/s is a term, MPa.cm^2 where A*p is. The shortest such
/// spelling; UDUNITS' own where no term has one. The equation's unit must be known.
std::string equation_unit(const Model& model, const Equation& equation);

}  // namespace algest::model
