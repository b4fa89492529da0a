// SPDX-License-Identifier: GPL-3.0-or-later
// Model file -> the files that `generate` writes: an estimator's, or a filter's.
#include "generator/generate.hpp"

#include <algorithm>

#include "generator/filter_block.hpp"
#include "generator/planner.hpp"

namespace algest::generator {

namespace {

/// True where declared noise would serve the estimator and none is; least squares over windows keeps no window of what it absorbed.
bool lacks_noise(const model::Model& model) {
    const bool averages = model.estimator.functional == model::Functional::average;
    if (model.estimator.solve == model::Solver::least_squares && !averages) return false;
    return std::none_of(model.signals.begin(), model.signals.end(), [&](const model::Signal& s) { return s.deviation() || (averages && s.steady && !cln::zerop(*s.steady)); });
}

}  // namespace

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
    Generated out{plan->name, plan->notes, emit(*plan)};
    if (lacks_noise(*model)) {
        out.notes.push_back("no signal declares its noise: the estimator gives no standard deviations, and its ok does not know where noise decides; add noise = ... (a standard deviation) or "
                            "resolution = ... (a step) to what is measured, under [signals]");
    }
    return out;
}

}  // namespace algest::generator
