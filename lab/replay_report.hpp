// SPDX-License-Identifier: GPL-3.0-or-later
// The page that shows what an estimator said over a recording: one HTML file that needs nothing else.
#pragma once
#include <string>
#include <vector>

#include "generator/plan.hpp"
#include "lab/replay.hpp"
#include "lab/report_sections.hpp"

namespace algest::lab {

/// What `algest replay` did.
struct Replayed {
    const plan::Plan& plan;
    const model::Model& model;           ///< of the same file
    const Recording& recording;
    const Replay& replay;
    const ReplaySummary& summary;
    std::string derivation;              ///< of the plan, in LaTeX
    std::vector<std::string> doubts;     ///< what speaks against the estimates, in words
};

/// templates/report/replay.html.mustache, filled. The model is run freely with the median estimates beside the recording; where it cannot be, the
/// page says why. The same arguments give the same bytes: no date, no host. `draw` makes each figure; where it cannot, the page says so in the
/// figure's place and `diagnostics` gets one warning. Cost: a free run, and some tens of milliseconds a parameter and an output.
std::string replay_report(const Replayed& replayed, const PageFrame& frame, const Draw& draw, Diagnostics& diagnostics);

}  // namespace algest::lab
