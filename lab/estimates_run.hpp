// SPDX-License-Identifier: GPL-3.0-or-later
// The model with the estimates of a replay, ready to be run over the stretch that was replayed.
#pragma once
#include <optional>
#include <vector>

#include "generator/model.hpp"
#include "generator/plan.hpp"
#include "lab/replay.hpp"
#include "lab/simulate.hpp"

namespace algest::lab {

struct EstimatesRun {
    Recording stretch;                 ///< rows of the recording that were replayed
    Bench bench;                       ///< of them
    std::vector<double> parameters;    ///< by the model's: the median estimate, else the initial value
};

/// Nullopt, and errors in `diagnostics`, where nothing was estimated or the model cannot be simulated.
std::optional<EstimatesRun> estimates_run(const model::Model& model, const plan::Plan& plan, const Recording& recording, const Replay& replay, const ReplaySummary& summary, Diagnostics& diagnostics);

}  // namespace algest::lab
