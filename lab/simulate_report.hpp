// SPDX-License-Identifier: GPL-3.0-or-later
// The page that shows a free run beside the recording: one HTML file that needs nothing else.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "lab/report_sections.hpp"

namespace algest::lab {

/// What `algest simulate` did.
struct Simulation {
    const model::Model& model;
    const Recording& recording;
    const Bench& bench;
    const std::vector<double>& parameters;   ///< by the model's parameters
    std::set<std::string> given;             ///< names of those that the command line gave
    const FreeRun& run;
};

/// templates/report/simulate.html.mustache, filled. The same arguments give the same bytes: no date, no host. `draw` makes each figure; where
/// it cannot, the page says so in the figure's place and `diagnostics` gets one warning. Cost: some tens of milliseconds an output.
std::string simulate_report(const Simulation& simulation, const PageFrame& frame, const Draw& draw, Diagnostics& diagnostics);

}  // namespace algest::lab
