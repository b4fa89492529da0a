// SPDX-License-Identifier: GPL-3.0-or-later
// What formulas of the parameters are worth at the initial values that the model file declares.
#pragma once
#include <optional>

#include "generator/model.hpp"
#include "generator/polynomial.hpp"

namespace algest::model {

/// Nullopt where a parameter that occurs has no initial value. Variables: the model's parameters.
std::optional<exact::Rational> at_initial(const Polynomial& p, const Model& model);
/// Also where the denominator vanishes there.
std::optional<exact::Rational> at_initial(const Quotient& q, const Model& model);

}  // namespace algest::model
