// SPDX-License-Identifier: GPL-3.0-or-later
// What `algest replay` says beside its numbers: on what an estimate rests, what the data lack, what to change.
#pragma once
#include <optional>
#include <string>

#include "generator/diagnostics.hpp"
#include "generator/plan.hpp"
#include "lab/recording.hpp"
#include "lab/replay.hpp"

namespace algest::cli {

/// Standard deviations that the remarks need over a replay, lab::add_deviations' `most`.
constexpr std::size_t deviations_for_remarks = 32;

/// Notes of one replay: of the model, that another domain would serve; of the recording, why most samples are singular, that estimates rest on noise
/// alone, lie beyond their limits, are hardly told from zero, or differ by more than noise. Cost: samples x parameters.
void add_remarks(const std::string& model, const plan::Plan& plan, const lab::Recording& recording, const lab::Stretch& stretch, const lab::Replay& replay,
                 const lab::ReplaySummary& summary, Diagnostics& diagnostics);

/// Where a replay gave nothing: what its operating points lack, or which command tells what the recording does not excite. Empty: neither.
std::optional<std::string> what_it_lacks(const std::string& model, const std::string& recording, const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary);

}  // namespace algest::cli
