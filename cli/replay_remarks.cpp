// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/replay_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/replay_answer.hpp"
#include "lab/discrete_system.hpp"
#include "lab/standstill.hpp"

namespace algest::cli {

namespace {

/// That nothing moves but noise: in the whole stretch, or in the samples that the last estimate, which the summary shows, was made of.
std::optional<std::string> what_stands_still(const plan::Plan& plan, const lab::Recording& recording, const lab::Stretch& stretch, const lab::Replay& replay) {
    if (auto still = lab::standstill(plan, recording, stretch)) return still;
    const auto last = std::find(replay.status.rbegin(), replay.status.rend(), Status::ok);
    if (last == replay.status.rend()) return std::nullopt;
    const double to = replay.t[static_cast<std::size_t>(replay.status.rend() - last) - 1];
    const double from = std::max(to - (plan.samples_to_first_estimate() - 1) * plan.period, replay.t.front());
    const auto still = lab::standstill(plan, recording, {from, to});
    return still ? std::optional(fmt::format("behind the last estimate, from {:.6g} to {:.6g} s: {}", from, to, *still)) : std::nullopt;
}

bool every_window_is_singular(const lab::ReplaySummary& summary) {
    return summary.count[static_cast<std::size_t>(Status::ok)] == 0 && summary.count[static_cast<std::size_t>(Status::singular)] > 0;
}

}  // namespace

void add_remarks(const std::string& model, const plan::Plan& plan, const lab::Recording& recording, const lab::Stretch& stretch, const lab::Replay& replay,
                 const lab::ReplaySummary& summary, Diagnostics& diagnostics) {
    if (const auto advice = lab::advice_on_domain(plan, replay)) diagnostics.note(model, *advice);
    if (summary.count[static_cast<std::size_t>(Status::ok)] == 0) return;
    if (const auto still = what_stands_still(plan, recording, stretch, replay)) diagnostics.note(recording.file, *still);
}

std::optional<std::string> what_it_lacks(const std::string& model, const std::string& recording, const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    if (const auto missing = what_is_missing(plan, replay, summary)) return missing;
    if (plan.functional != plan::Functional::annihilator || plan.discrete || !every_window_is_singular(summary)) return std::nullopt;
    return fmt::format("no window tells all unknowns apart; what this recording does not excite is said by: algest design {} {}", model, recording);
}

}  // namespace algest::cli
