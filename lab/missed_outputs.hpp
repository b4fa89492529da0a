// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the model with the estimates of a replay goes where the machine went: estimates may agree with each other and be wrong together.
#pragma once
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "generator/plan.hpp"
#include "lab/replay.hpp"

namespace algest::lab {

/// An output that a free run with the median estimates misses.
struct MissedOutput {
    std::string signal;
    std::string unit;
    double rmse;         ///< in that unit, over the second half of the run
    double floors;       ///< over the noise that the sensor declares
    double share;        ///< over the size of the measured signal
    double from_s;
    double to_s;
};

/// What is a miss. Ten floors: twice is where a fit stops being explained by noise (free_run_reference.hpp), and medians are no fit of the run. A twentieth
/// of the signal: noise of the process itself (torque that ripples) moves a sound machine by some percent, and no sensor's noise foretells it. Three times what
/// is known to be uncertain: a sum of several parts, none of it normal.
constexpr double missed_floors = 10.0;
constexpr double missed_share = 0.05;
constexpr double missed_beyond_uncertainty = 3.0;

/// Outputs with declared noise that a free run with the median estimates over what was replayed misses by more than all of these: missed_floors of that noise,
/// missed_share of the signal, and what the start, the declared noise of the inputs, and the range and bias of the estimates explain.
/// Empty, too, where such a run says nothing: the model cannot be simulated, has a hidden state or a late sensor, an equation leaves a perturbation open (kappa
/// above 0), a parameter has no estimate, or there are fewer than a hundred. An output that does not forget a disturbed start (an angle that integrates, an unstable plant) is not looked at.
/// Cost: parameters + 3 free runs of about `most_effort_of_a_look` operations together; a longer recording is looked at so far.
std::vector<MissedOutput> missed_outputs(const model::Model& model, const plan::Plan& plan, const Recording& recording, const Replay& replay, const ReplaySummary& summary);
constexpr double most_effort_of_a_look = 1e9;   ///< 1.5 s

}  // namespace algest::lab
