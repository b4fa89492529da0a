// SPDX-License-Identifier: GPL-3.0-or-later
// Rows that are linear in more columns than there are parameters, the columns being polynomials of them: solve = "elimination".
#pragma once
#include <optional>
#include <vector>

#include "generator/lumping.hpp"

namespace algest::lumping {

/// Takes the equations as they are written, stage by stage: one stage of all, or one for each entry of `stages`, in which the parameters of those
/// before are known. The columns are the products of parameters that occur, or fewer combinations of them. Complains about equations without a
/// known side, parameters that no data tell apart, and more than two parameters of a stage that do not stand alone, naming a term.
std::optional<Lumping> lump_constrained(const model::Model& model, const std::vector<equation::OperatorForm>& forms, Diagnostics& diagnostics);

}  // namespace algest::lumping
