// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/replay_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "lab/discrete_system.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(std::optional<double> value) {
    return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json candidates_json(const std::vector<lab::EliminationCandidate>& candidates) {
    ordered_json out = ordered_json::array();
    for (const lab::EliminationCandidate& c : candidates) {
        ordered_json values = ordered_json::object();
        for (const auto& value : c.values) values[value.name] = number_or_null(value.value);
        out.push_back({{"equations", c.equations}, {"values", std::move(values)}, {"error", number_or_null(c.error)}, {"standing", lab::name(c.standing)}});
    }
    return out;
}

std::string candidates_text(const std::vector<lab::EliminationCandidate>& candidates) {
    std::string out;
    for (const lab::EliminationCandidate& c : candidates) {
        std::string values;
        for (const auto& value : c.values) values += fmt::format("{} = {:.6g}, ", value.name, value.value);
        out += fmt::format("  {}: {}squared error {:.5g}: {}\n", c.equations, values, c.error, lab::in_words(c.standing));
    }
    return out.empty() ? out : "\ncandidates:\n" + out;
}

ordered_json pairs(const std::vector<std::complex<double>>& values) {
    ordered_json out = ordered_json::array();
    for (const std::complex<double> x : values) out.push_back({x.real(), x.imag()});
    return out;
}

/// What a discrete-time estimator's last values say; nothing where none was ok.
std::optional<lab::DiscreteSystem> system_of(const plan::Plan& plan, const lab::ReplaySummary& summary) {
    if (!plan.discrete || !summary.condition_last) return std::nullopt;
    std::vector<double> last;
    for (const std::optional<double> value : summary.last) last.push_back(value.value_or(std::nan("")));
    return lab::discrete_system(plan, last);
}

void add_system(const plan::Plan& plan, const lab::ReplaySummary& summary, ordered_json& out) {
    const auto system = system_of(plan, summary);
    out["poles_s"] = system ? pairs(system->poles_s) : ordered_json(nullptr);
    if (!system) return;
    out["poles_z"] = pairs(system->poles_z);
    out["zeros_z"] = pairs(system->zeros_z);
    out["z"] = {{"a", system->a}, {"b", system->b}};
    out["q"] = {{"A", system->A}, {"B", system->B}};
}

}  // namespace

std::optional<std::string> what_is_missing(const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    return lab::what_is_missing(plan, replay.points, summary.count[static_cast<std::size_t>(Status::ok)] > 0);
}

std::vector<std::string> texts_of(const Diagnostics& notes) {
    std::vector<std::string> out;
    for (const Diagnostic& d : notes.sorted()) if (d.severity == Severity::note) out.push_back(d.what);
    return out;
}

ordered_json replay_json(const std::string& model, const std::string& recording, const plan::Plan& plan, const lab::Replay& replay,
                         const lab::ReplaySummary& summary) {
    ordered_json parameters = ordered_json::array();
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        parameters.push_back({{"name", plan.parameters[p].name},
                              {"unit", plan.parameters[p].unit},
                              {"last", number_or_null(summary.last[p])},
                              {"median", number_or_null(summary.median[p])},
                              {"sd", number_or_null(summary.deviation[p])},
                              {"bias", number_or_null(summary.bias[p])}});
    }
    ordered_json status = ordered_json::object();
    for (std::size_t s = 0; s < summary.count.size(); ++s) status[name(static_cast<Status>(s))] = summary.count[s];
    ordered_json out = {{"model", model},
            {"recording", recording},
            {"samples", replay.samples()},
            {"period_s", plan.period},
            {"parameters", std::move(parameters)},
            {"status", std::move(status)},
            {"condition",
             {{"median", number_or_null(summary.condition_median)}, {"last", number_or_null(summary.condition_last)}}}};
    if (plan.steady) {
        out["operating_points"] = replay.points.count();
        out["missing"] = ordered_json::array();
        if (const auto missing = what_is_missing(plan, replay, summary)) out["missing"].push_back(*missing);
    }
    if (plan.elimination) out["candidates"] = candidates_json(replay.candidates);
    if (plan.discrete) add_system(plan, summary, out);
    return out;
}

namespace {

std::string number_text(std::optional<double> value) { return value ? fmt::format("{:.6g}", *value) : "-"; }

/// Continuous-time poles, one a line.
std::string poles_text(const plan::Plan& plan, const lab::ReplaySummary& summary) {
    const auto system = system_of(plan, summary);
    std::string out = system ? "\npoles of the last ok sample [rad/s]\n" : "";
    for (const std::complex<double> s : system ? system->poles_s : std::vector<std::complex<double>>()) out += fmt::format("{:>12.6g}  {:>+12.6g} i\n", s.real(), s.imag());
    return out;
}

}  // namespace

std::string replay_text(const plan::Plan& plan, const lab::Replay& replay, const lab::ReplaySummary& summary) {
    std::size_t width = std::string("parameter").size();
    for (const plan::Parameter& p : plan.parameters) width = std::max(width, p.name.size());
    const bool deviations = std::any_of(summary.deviation.begin(), summary.deviation.end(), [](const auto& d) { return d.has_value(); });
    const auto if_known = [&](const std::string& text) { return deviations ? fmt::format("{:>12}  ", text) : std::string(); };
    std::string out = fmt::format("{:<{}}  {:>12}  {}{}{:>12}  {}\n", "parameter", width, "last", if_known("sd"), if_known("bias"), "median", "unit");
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        out += fmt::format("{:<{}}  {:>12}  {}{}{:>12}  {}\n", plan.parameters[p].name, width, number_text(summary.last[p]),
                           if_known(number_text(summary.deviation[p])), if_known(number_text(summary.bias[p])), number_text(summary.median[p]), plan.parameters[p].unit);
    }
    out += fmt::format("\n{} samples, {:.6g} s to {:.6g} s:", replay.samples(), replay.t.front(), replay.t.back());
    for (std::size_t s = 0; s < summary.count.size(); ++s) {
        out += fmt::format("{} {} {}", s == 0 ? "" : ",", name(static_cast<Status>(s)), summary.count[s]);
    }
    out += fmt::format("\ncondition: median {}, last {}\n", number_text(summary.condition_median),
                       number_text(summary.condition_last));
    out += poles_text(plan, summary);
    if (plan.steady) out += fmt::format("{} operating points\n", replay.points.count());
    return out + candidates_text(replay.candidates);
}

}  // namespace algest::cli
