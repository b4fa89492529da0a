// SPDX-License-Identifier: GPL-3.0-or-later
// Model -> plan: how the rows are solved, and when an answer is no answer.
#pragma once
#include "generator/model.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// Solver, length of S(t), limits and filters of the plan, which has its scalar and its equations already. Cost: that of a few roundings.
void plan_solver(const model::Model& model, plan::Plan& plan);

}  // namespace algest::generator
