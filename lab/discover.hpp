// SPDX-License-Identifier: GPL-3.0-or-later
// The gap workflow: simulate, fit, locate, name, amend, confirm (design.md, section 6).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "lab/discovery.hpp"
#include "lab/effects.hpp"
#include "lab/recording.hpp"
#include "lab/selection.hpp"

namespace algest::lab {

struct DiscoverOptions {
    std::optional<std::pair<double, double>> train_s;     ///< of each recording; default: the first 70 percent
    std::optional<std::pair<double, double>> test_s;      ///< default: the rest
};

/// The whole workflow on one recording, or on several of one machine: one fit over all of them, each from an initial state of its own; their
/// periods and lengths may differ. Nullopt, and errors in `diagnostics`, where model and recordings do not go together.
std::optional<Discovery> discover(const std::string& model_text, const std::string& model_path, const std::vector<Recording>& recordings,
                                  const std::vector<Effect>& effects, const DiscoverOptions& options, Diagnostics& diagnostics, const StepReport& progress = {});

}  // namespace algest::lab
