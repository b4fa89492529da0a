// SPDX-License-Identifier: GPL-3.0-or-later
// Model -> plan, for a model that is read already.
#pragma once
#include "generator/generate.hpp"
#include "generator/model.hpp"

namespace algest::generator {

/// As plan_from_model.
std::optional<plan::Plan> plan_of(const model::Model& model, const PlanOptions& options, Diagnostics& diagnostics);

}  // namespace algest::generator
