// SPDX-License-Identifier: GPL-3.0-or-later
// The page that tells an engineer what a discovery found: one HTML file that needs nothing else.
#pragma once
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "lab/discovery.hpp"
#include "lab/gnuplot.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// The files that a report speaks of, as the user would type them.
struct ReportFiles {
    std::string model;
    std::vector<std::string> recordings;   ///< one at least
    std::string directory;     ///< where the report lies
    std::string amended;       ///< model with what was found; empty: none
    std::string patch_file;    ///< empty: none
    std::string patch;         ///< unified diff, its text
};

/// templates/report/discover.html.mustache, filled. `model` is the nominal one, whose signals number the runs of `discovery`; `recording` is
/// the first one, which the figures show. The same
/// arguments give the same bytes: no date, no host. `draw` makes each figure; where it cannot, the page says so in the figure's place
/// and `diagnostics` gets one warning. Cost: some tens of milliseconds a figure, two figures an equation and one an output.
std::string report_html(const Discovery& discovery, const model::Model& model, const Recording& recording, const ReportFiles& files, const Draw& draw,
                        Diagnostics& diagnostics);

}  // namespace algest::lab
