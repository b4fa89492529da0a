// SPDX-License-Identifier: GPL-3.0-or-later
// Model -> plan: the unknowns of the rows, the physical parameters as formulas of them, and what a perturbation's coefficients are.
#pragma once
#include "generator/lumping.hpp"
#include "generator/model.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// Unknowns, parameters, their map and its derivatives (where deviations are computed), of a plan whose rows stand.
void plan_parameters(const model::Model& model, const lumping::Lumping& lumping, plan::Plan& plan);

}  // namespace algest::generator
