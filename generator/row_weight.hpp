// SPDX-License-Identifier: GPL-3.0-or-later
// Constants that make rows of different equations and different p comparable where they are pooled.
#pragma once
#include <optional>
#include <vector>

#include "generator/row_functional.hpp"

namespace algest::generator {

/// One positive power of two per row.
using RowWeights = std::vector<exact::Rational>;

/// 1 for a square system. Where rows are pooled, row p of an equation is divided by the norm of its kernel of order n and by
/// the noise of its equation: declared noise of the signal with the highest derivative times |its coefficient| and what the functional
/// makes of it, else the written scale, else 1 where all equations that share unknowns have one unit. Rounded to powers of two, so that they cost
/// no digit. Complains where units are mixed and neither is declared.
std::optional<RowWeights> row_weights(const model::Model& model, const std::vector<equation::OperatorForm>& forms,
                                      const lumping::Lumping& lumping, const std::vector<ChosenRow>& rows, RowFunctional& functional,
                                      Diagnostics& diagnostics);

}  // namespace algest::generator
