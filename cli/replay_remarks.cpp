// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/replay_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/replay_answer.hpp"
#include "lab/discrete_system.hpp"
#include "lab/doubt.hpp"
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

/// What made samples singular, where most of those that were solved are.
std::optional<std::string> what_makes_singular(const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    const std::size_t singular = summary.count[static_cast<std::size_t>(Status::singular)];
    if (singular <= summary.count[static_cast<std::size_t>(Status::ok)]) return std::nullopt;
    std::size_t without_rank = 0;
    std::size_t by_condition = 0;
    for (std::size_t k = 0; k < replay.samples(); ++k) {
        if (replay.status[k] != Status::singular) continue;
        if (std::isinf(replay.condition[k])) ++without_rank;
        else if (replay.condition[k] > plan.condition_limit) ++by_condition;
    }
    std::string out = fmt::format("{} samples are singular:", singular);
    const auto add = [&](std::size_t count, const std::string& why) { if (count > 0) out += fmt::format("{} {} {}", out.back() == ':' ? "" : ",", count, why); };
    add(without_rank, "since rows depend on each other");
    add(by_condition, fmt::format("by a condition above condition_limit = {:.4g}", plan.condition_limit));
    add(singular - without_rank - by_condition, "by noise, of which unknowns are made too uncertain or which is most of what the rows see");
    return out;
}

/// Estimates that cannot be: how many of the ok ones lie beyond a declared min or max. Noise takes a few of them across.
void add_what_lies_beyond(const model::Model& model, const plan::Plan& plan, const lab::Recording& recording, const lab::Replay& replay, std::size_t ok, Diagnostics& diagnostics) {
    constexpr double a_few = 0.05;
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        const int declared = model.parameter_index(plan.parameters[p].name);
        if (declared < 0) continue;
        const model::Parameter& parameter = model.parameters[static_cast<std::size_t>(declared)];
        const lab::Limits limits = lab::limits_of(parameter);
        std::size_t beyond = 0;
        for (std::size_t k = 0; k < replay.samples(); ++k) beyond += replay.status[k] == Status::ok && !limits.hold(replay.parameter(k, p)) ? 1 : 0;
        if (static_cast<double>(beyond) <= a_few * static_cast<double>(ok)) continue;
        diagnostics.note(recording.file, fmt::format("{} of {} ok estimates of {} lie beyond its min or max: a sensor that is stuck, a unit, or what the model misses (algest discover)", beyond, ok, parameter.name));
    }
}

/// Parameters that operating points do not tell from zero. They have one answer, of all points; what slides over a recording has moments at which that is so.
void add_what_is_doubtful(const model::Model& model, const plan::Plan& plan, const lab::Recording& recording, const lab::ReplaySummary& summary, Diagnostics& diagnostics) {
    for (std::size_t p = 0; plan.steady && p < plan.parameters.size(); ++p) {
        const int declared = model.parameter_index(plan.parameters[p].name);
        if (declared < 0 || !summary.last[p] || !summary.deviation[p]) continue;
        if (const auto why = lab::doubt(model.parameters[static_cast<std::size_t>(declared)], *summary.last[p], summary.deviation[p])) diagnostics.note(recording.file, "doubtful: " + *why);
    }
}

bool every_window_is_singular(const lab::ReplaySummary& summary) {
    return summary.count[static_cast<std::size_t>(Status::ok)] == 0 && summary.count[static_cast<std::size_t>(Status::singular)] > 0;
}

}  // namespace

void add_remarks(const std::string& model, const plan::Plan& plan, const lab::Recording& recording, const lab::Stretch& stretch, const lab::Replay& replay,
                 const lab::ReplaySummary& summary, Diagnostics& diagnostics) {
    if (const auto advice = lab::advice_on_domain(plan, replay)) diagnostics.note(model, *advice);
    if (const auto why = what_makes_singular(plan, replay, summary)) diagnostics.note(recording.file, *why);
    const std::size_t ok = summary.count[static_cast<std::size_t>(Status::ok)];
    if (ok == 0) return;
    Diagnostics said_before;   // by plan_from_model, of the same file
    if (const auto declared = model::read(model, false, said_before)) {
        add_what_lies_beyond(*declared, plan, recording, replay, ok, diagnostics);
        add_what_is_doubtful(*declared, plan, recording, summary, diagnostics);
    }
    if (const auto still = what_stands_still(plan, recording, stretch, replay)) diagnostics.note(recording.file, *still);
}

std::optional<std::string> what_it_lacks(const std::string& model, const std::string& recording, const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    if (const auto missing = what_is_missing(plan, replay, summary)) return missing;
    if (plan.functional != plan::Functional::annihilator || plan.discrete || !every_window_is_singular(summary)) return std::nullopt;
    return fmt::format("no window tells all unknowns apart; what this recording does not excite is said by: algest design {} {}", model, recording);
}

}  // namespace algest::cli
