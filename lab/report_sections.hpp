// SPDX-License-Identifier: GPL-3.0-or-later
// Sections that the reports of replay and simulate share: measured against simulated, and the model in mathematical notation.
#pragma once
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "lab/report_page.hpp"
#include "lab/simulate.hpp"

namespace algest::lab {

/// A table of errors with units and a figure for each simulated signal; templates/report/outputs.html.mustache, filled.
/// Cost: some tens of milliseconds a figure.
std::string outputs_html(const model::Model& model, const Recording& recording, const Bench& bench, const FreeRun& run, Figures& figures);

/// Equations, computed signals and control laws of the model.
std::string model_html(const model::Model& model);

/// What stands at the head and at the foot of a page: model_name, model_summary, model_source, model_file, recording_file, command, style.
struct PageFrame {
    std::string model_file;
    std::string recording_file;
    std::vector<std::string> command;   ///< the words that made the page, without the program's name
};
void set_frame(Data& page, const PageFrame& frame, const std::string& name, const std::string& summary, const std::string& source);

}  // namespace algest::lab
