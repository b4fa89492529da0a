// SPDX-License-Identifier: GPL-3.0-or-later
// What `algest replay` answers of one recording: JSON for programs, text for people.
#pragma once
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/plan.hpp"
#include "lab/replay.hpp"

namespace algest::cli {

/// {"model", "recording", "samples", "period_s", "parameters": [{"name", "unit", "last", "median", "sd", "bias"}], "status", "condition",
/// "missing": [text], ...}
nlohmann::ordered_json replay_json(const std::string& model, const std::string& recording, const plan::Plan& plan, const lab::Replay& replay,
                                   const lab::ReplaySummary& summary);

/// What was said beside the numbers, a sentence each: "notes" of that answer, doubts of its page.
std::vector<std::string> texts_of(const Diagnostics& notes);

/// What the data lack where operating points gave no answer, in words; empty: nothing.
std::optional<std::string> what_is_missing(const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary);

std::string replay_text(const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary);

}  // namespace algest::cli
