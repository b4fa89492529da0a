// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/engine_choice.hpp"

#include "generator/cost.hpp"
#include "generator/planner.hpp"

namespace algest::lab {

namespace {

/// A multiply-add of moments against one of a dot product, which vectorises. bench/engines on a PC: 0.43 ns against 0.12 ns in long windows, which makes
/// 3.6; about as long in windows of 20 samples, where rows cost more than sums. Chosen between the two: it errs for tables, which need less memory there.
constexpr double slower = 2.5;

}  // namespace

EngineChoice cheaper_engine(const model::Model& model) {
    EngineChoice out{"", 0};
    double least = 0;
    for (const char* engine : {"fir", "moments"}) {
        generator::PlanOptions options;
        options.engine = engine;
        options.weights = false;
        Diagnostics unsaid;   // an engine that the model cannot have is no choice
        const auto plan = generator::plan_of(model, options, unsaid);
        if (!plan || plan->moments.has_value() != (options.engine == "moments")) continue;
        const generator::Cost cost = generator::cost_of(*plan);
        const double time = static_cast<double>(cost.push * cost.operations + cost.estimate * 2) * (plan->moments ? slower : 1.0);
        if (!out.engine.empty() && time >= least) continue;
        out = {engine, cost.push + cost.estimate};
        least = time;
    }
    return out;
}

}  // namespace algest::lab
