// SPDX-License-Identifier: GPL-3.0-or-later
// Model -> plan, for a model that is read already.
#pragma once
#include "generator/equation.hpp"
#include "generator/generate.hpp"
#include "generator/model.hpp"

namespace algest::generator {

/// The operator form of every equation, in order; in a steady state for averages. Empty when `diagnostics` says why not.
std::optional<std::vector<equation::OperatorForm>> operator_forms(const model::Model& model, Diagnostics& diagnostics);

/// As plan_from_model.
std::optional<plan::Plan> plan_of(const model::Model& model, const PlanOptions& options, Diagnostics& diagnostics);

}  // namespace algest::generator
