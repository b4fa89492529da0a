// SPDX-License-Identifier: GPL-3.0-or-later
// Model file -> the files that `generate` writes: an estimator's, or a filter's.
#include "generator/generate.hpp"

#include "generator/filter_block.hpp"
#include "generator/planner.hpp"

namespace algest::generator {

std::optional<plan::Plan> plan_from_model(const std::string& path, const PlanOptions& options, Diagnostics& diagnostics) {
    const auto model = model::read(path, false, diagnostics);
    if (!model) return std::nullopt;
    if (model->filter) {
        diagnostics.error(path, model->filter->at, "a model with [filter] has no estimator", "`algest generate` writes the filter, and its derivation beside it");
        return std::nullopt;
    }
    return plan_of(*model, options, diagnostics);
}

std::optional<Generated> generate(const std::string& path, const PlanOptions& options, Diagnostics& diagnostics) {
    const auto model = model::read(path, false, diagnostics);
    if (!model) return std::nullopt;
    if (model->filter) return Generated{model->name, {}, emit_filter(filter_block(*model, options.scalar))};
    const auto plan = plan_of(*model, options, diagnostics);
    if (!plan) return std::nullopt;
    return Generated{plan->name, plan->notes, emit(*plan)};
}

}  // namespace algest::generator
