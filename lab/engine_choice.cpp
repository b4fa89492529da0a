// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/engine_choice.hpp"

#include "generator/cost.hpp"
#include "generator/planner.hpp"

namespace algest::lab {

EngineChoice cheaper_engine(const model::Model& model) {
    EngineChoice out{"", 0};
    long least = 0;
    for (const char* engine : {"fir", "moments"}) {
        generator::PlanOptions options;
        options.engine = engine;
        options.weights = false;
        Diagnostics unsaid;   // an engine that the model cannot have is no choice
        const auto plan = generator::plan_of(model, options, unsaid);
        if (!plan || plan->moments.has_value() != (options.engine == "moments")) continue;
        const generator::Cost cost = generator::cost_of(*plan);
        const long operations = cost.push * cost.operations + cost.estimate * 2;
        if (!out.engine.empty() && operations >= least) continue;
        out = {engine, cost.push + cost.estimate};
        least = operations;
    }
    return out;
}

}  // namespace algest::lab
