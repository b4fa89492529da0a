// SPDX-License-Identifier: GPL-3.0-or-later
// [discrete] -> the rows, tables and unknowns of a plan (004).
#pragma once
#include "generator/generate.hpp"
#include "generator/model.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// Completes a plan whose head is there: model.discrete must be, and with solve = "square" a window. Every weight is the nearest number of
/// the plan's scalar to an exact one; each table is scaled by a power of two so that its weights add up, without their signs, to at most 1, and
/// the factor of its term takes the scale. Cost: rows x unknowns x samples long integers.
void plan_discrete(const model::Model& model, const PlanOptions& options, plan::Plan& plan);

}  // namespace algest::generator
