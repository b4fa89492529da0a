// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/replay_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cli/replay_answer.hpp"
#include "lab/discrete_system.hpp"
#include "lab/doubt.hpp"
#include "lab/missed_outputs.hpp"
#include "lab/noise.hpp"
#include "lab/scatter.hpp"
#include "lab/standstill.hpp"
#include "lab/stuck_sensor.hpp"

namespace algest::cli {

namespace {

constexpr double a_few = 0.05;   ///< of the ok estimates: noise takes as many across a limit

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
std::optional<std::string> what_lies_beyond(const model::Parameter& parameter, const lab::Replay& replay, std::size_t p, std::size_t ok) {
    const lab::Limits limits = lab::limits_of(parameter);
    std::size_t beyond = 0;
    for (std::size_t k = 0; k < replay.samples(); ++k) beyond += replay.status[k] == Status::ok && !limits.hold(replay.parameter(k, p)) ? 1 : 0;
    if (static_cast<double>(beyond) <= a_few * static_cast<double>(ok)) return std::nullopt;
    return fmt::format("{} of {} ok estimates of {} lie beyond its min or max: a sensor that is stuck, a unit, or what the model misses (algest discover)", beyond, ok, parameter.name);
}

/// The last estimate, where its noise is most of it.
std::optional<std::string> what_is_hardly_told(const std::string& parameter, double last, double deviation) {
    if (!lab::hardly_told_from_zero(last, deviation)) return std::nullopt;
    return fmt::format("the last estimate of {} is {:.3g} with a standard deviation of {:.2g}: not even its sign is known, though the unknowns that it is made of are ok", parameter, last, deviation);
}

/// The last estimate, where it lies far from the others, by its own deviation and by theirs: the summary shows it, and a controller would take it.
std::optional<std::string> what_stands_apart(const std::string& parameter, const lab::Replay& replay, const lab::ReplaySummary& summary, std::size_t p) {
    const double middle = *summary.median[p];
    const double off = std::abs(*summary.last[p] - middle);
    if (off <= lab::more_than_noise * *summary.deviation[p] || off <= lab::more_than_noise * lab::spread(replay, p)) return std::nullopt;
    return fmt::format("the last estimate of {}, {:.4g}, lies {:.0f} of its standard deviations from the median of all, {:.4g}: a parameter or a load changed, or a sensor failed", parameter, *summary.last[p],
                       off / *summary.deviation[p], middle);
}

/// Without declared noise ok does not know it: how many estimates lie more than half off the middle one.
std::optional<std::string> what_no_noise_explains(const std::string& parameter, const lab::Replay& replay, const lab::ReplaySummary& summary, std::size_t p, std::size_t ok) {
    const double middle = *summary.median[p];
    std::size_t off = 0;
    for (std::size_t k = 0; k < replay.samples(); ++k) off += replay.status[k] == Status::ok && !(std::abs(replay.parameter(k, p) - middle) <= 0.5 * std::abs(middle)) ? 1 : 0;
    if (static_cast<double>(off) <= a_few * static_cast<double>(ok)) return std::nullopt;
    return fmt::format("{} of {} ok estimates of {} lie more than half off their median, {:.4g}: no signal declares its noise, so that ok does not know it (noise = ... under [signals])", off, ok, parameter, middle);
}

/// Parameters whose estimates differ by more than noise from window to window.
std::optional<std::string> what_scatters(const plan::Plan& plan, const lab::Replay& replay) {
    std::string found;
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        const auto scatter = lab::scatter_in_deviations(replay, p);
        if (scatter && *scatter >= lab::more_than_noise) found += fmt::format("{}{} by {:.0f}", found.empty() ? "" : ", ", plan.parameters[p].name, *scatter);
    }
    if (found.empty()) return std::nullopt;
    return fmt::format("estimates scatter over the recording by more than their standard deviations: {}; the sensors are noisier or coarser than declared, one failed, a parameter changes, "
                       "the model misses something (algest discover), or a signal is held otherwise between samples", found);
}

/// Outputs that the model with its estimates does not follow.
std::optional<std::string> what_is_missed(const std::string& path, const model::Model& model, const plan::Plan& plan, const lab::Recording& recording, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    const std::vector<lab::MissedOutput> missed = lab::missed_outputs(model, plan, recording, replay, summary);
    if (missed.empty()) return std::nullopt;
    std::string outputs;
    for (const lab::MissedOutput& m : missed) {
        outputs += fmt::format("{}{} by {:.3g} {}rms ({:.3g} times its declared noise, {:.0f} percent of its size)", outputs.empty() ? "" : ", ", m.signal, m.rmse, m.unit.empty() ? "" : m.unit + " ", m.floors, 100 * m.share);
    }
    return fmt::format("a free run with the median estimates misses {} from {:.6g} to {:.6g} s: a constant or a unit is wrong, the model misses something, or a disturbance that it does not know moved the machine; to look for it: algest discover {} {} -o found", outputs,
                       missed.front().from_s, missed.front().to_s, path, recording.file);
}

/// What speaks against the estimates of each parameter.
void add_doubts(const std::string& path, const plan::Plan& plan, const lab::Recording& recording, const lab::Stretch& stretch, const lab::Replay& replay, const lab::ReplaySummary& summary, std::size_t ok, Diagnostics& diagnostics) {
    Diagnostics said_before;   // by plan_from_model, of the same file
    const auto model = model::read(path, false, said_before);
    if (!model) return;
    const bool undeclared = std::none_of(model->signals.begin(), model->signals.end(), lab::declares_noise);
    const auto note = [&](const std::optional<std::string>& text) { if (text) diagnostics.note(recording.file, *text); };
    bool apart = false;
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        const std::string& name = plan.parameters[p].name;
        const int declared = model->parameter_index(name);
        if (declared >= 0) note(what_lies_beyond(model->parameters[static_cast<std::size_t>(declared)], replay, p, ok));
        if (summary.deviation[p]) {
            note(what_is_hardly_told(name, *summary.last[p], *summary.deviation[p]));
            const auto stands = what_stands_apart(name, replay, summary, p);
            note(stands);
            apart = apart || stands;
        } else if (undeclared && plan.solve != Solve::least_squares) {
            note(what_no_noise_explains(name, replay, summary, p, ok));
        }
    }
    note(what_scatters(plan, replay));
    note(lab::stuck_sensor(*model, plan, recording, stretch));
    if (!apart) note(what_is_missed(path, *model, plan, recording, replay, summary));   // else a parameter changed, and no run with constant ones follows
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
    add_doubts(model, plan, recording, stretch, replay, summary, ok, diagnostics);
    if (const auto still = what_stands_still(plan, recording, stretch, replay)) diagnostics.note(recording.file, *still);
}

std::optional<std::string> what_it_lacks(const std::string& model, const std::string& recording, const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    if (const auto missing = what_is_missing(plan, replay, summary)) return missing;
    if (plan.functional != plan::Functional::annihilator || plan.discrete || !every_window_is_singular(summary)) return std::nullopt;
    return fmt::format("no window tells all unknowns apart; what this recording does not excite is said by: algest design {} {}", model, recording);
}

}  // namespace algest::cli
