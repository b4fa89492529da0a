// SPDX-License-Identifier: GPL-3.0-or-later
// Rows are linear in products of unknowns: parameters that an equation is not linear in are held at their initial values.
#pragma once
#include <optional>

#include "generator/equation.hpp"

namespace algest::lab {

/// The operator form of an equation; where there is none, with every parameter that stands inside a function, a power or a denominator as the
/// number that its `initial` is. Nullopt where that has none either.
std::optional<equation::OperatorForm> form_with_held_parameters(const model::Model& model, std::size_t equation);

}  // namespace algest::lab
