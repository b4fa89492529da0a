// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/discovery_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// Null where the data do not see it, for a number that is not finite is no JSON.
ordered_json number_or_null(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); }

ordered_json parameters_json(const std::vector<lab::NamedParameter>& parameters) {
    ordered_json out = ordered_json::array();
    for (const lab::NamedParameter& p : parameters) out.push_back({{"name", p.name}, {"unit", p.unit}, {"value", p.value}, {"sd", number_or_null(p.sd)}});
    return out;
}

ordered_json effect_json(const lab::NamedEffect& effect) {
    return {{"name", effect.name}, {"equation", effect.equation}, {"term", effect.term}, {"parameters", parameters_json(effect.parameters)}};
}

ordered_json evidence_json(const lab::Evidence& e) {
    return {{"step", e.step}, {"effect", e.effect}, {"equation", e.equation}, {"term", e.term}, {"strength", number_or_null(e.strength)}, {"validation", number_or_null(e.validation)},
            {"gain", number_or_null(e.improvement)}, {"chosen", e.chosen}, {"rival", e.rival}};
}

ordered_json outputs_json(const std::vector<lab::OutputGap>& outputs) {
    ordered_json out = ordered_json::array();
    for (const auto& o : outputs) out.push_back({{"signal", o.signal}, {"nrmse_before", o.before}, {"nrmse_after", o.after}, {"noise_floor", o.floor}});
    return out;
}

ordered_json recordings_json(const lab::Discovery& d, const DiscoveryFiles& files) {
    ordered_json out = ordered_json::array();
    for (std::size_t k = 0; k < d.recordings.size(); ++k) {
        const lab::RecordingEvidence& r = d.recordings[k];
        out.push_back({{"recording", r.file}, {"train_s", {r.train_from_s, r.train_to_s}}, {"test_s", {r.test_from_s, r.test_to_s}}, {"gain", r.gain},
                       {"outputs", outputs_json(r.outputs)}, {"before", files.before[k]}, {"after", files.after[k]}});
    }
    return out;
}

/// "R = 3.01 +- 0.02 ohm"
std::string with_deviation(const lab::NamedParameter& p) {
    const std::string unit = p.unit.empty() ? "(no unit)" : p.unit;
    if (!std::isfinite(p.sd)) return fmt::format("{}: not seen by the data; the fit stopped at {:.6g} {}", p.name, p.value, unit);
    return fmt::format("{} = {:.6g} +- {:.2g} {}", p.name, p.value, p.sd, unit);
}

}  // namespace

ordered_json discovery_json(const lab::Discovery& d, const DiscoveryFiles& files, bool amended) {
    ordered_json out;
    out["verdict"] = lab::name(d.verdict);
    out["effects"] = ordered_json::array();
    for (const auto& e : d.effects) out["effects"].push_back(effect_json(e));
    out["alternatives"] = d.alternatives;
    out["experiments"] = d.experiments;
    out["doubts"] = d.doubts;
    out["evidence"] = ordered_json::array();
    for (const auto& e : d.evidence) out["evidence"].push_back(evidence_json(e));
    out["parameters_before"] = parameters_json(d.parameters_before);
    out["parameters_after"] = parameters_json(d.parameters_after);
    out["where"] = ordered_json::array();
    for (const auto& w : d.where) out["where"].push_back({{"equation", w.equation}, {"share", w.share}, {"from_s", w.from_s}, {"to_s", w.to_s}, {"region", w.region}});
    out["outputs"] = outputs_json(d.first().outputs);
    out["recordings"] = recordings_json(d, files);
    out["model"] = amended ? ordered_json(files.model) : ordered_json(nullptr);
    out["patch"] = amended ? ordered_json(files.patch) : ordered_json(nullptr);
    out["report"] = files.report;
    return out;
}

std::string discovery_text(const lab::Discovery& d, const std::string& report_file) {
    std::string out = fmt::format("verdict: {}\n", lab::name(d.verdict));
    const bool one_of_several = d.verdict == lab::Verdict::ambiguous;
    for (const auto& e : d.effects) {
        out += fmt::format("  {}{} in {}: {}\n", one_of_several ? "one that would do, no more than that: " : "", e.name, e.equation, e.term);
        for (const auto& p : e.parameters) out += fmt::format("    {}\n", with_deviation(p));
    }
    for (const auto& a : d.alternatives) out += fmt::format("  the data allow: {}\n", fmt::join(a, ", "));
    for (const auto& e : d.experiments) out += fmt::format("  to tell: {}\n", e);
    for (const auto& e : d.doubts) out += fmt::format("  doubt: {}\n", e);
    if (!d.evidence.empty()) out += fmt::format("\n{:<4} {:<22} {:<28} {:>12} {:>14} {:>12}\n", "step", "effect", "equation", "strength [1]", "validation [1]", "gain [1]");
    for (const auto& e : d.evidence) {
        out += fmt::format("{:<4} {:<22} {:<28} {:>12.3g} {:>14.4g} {:>12.3g}{}\n", e.step, e.effect, e.equation, e.strength, e.validation, e.improvement, e.chosen ? (d.effects.empty() ? "  likeliest" : "  chosen") : e.rival ? "  rival" : "");
    }
    out += "\nwhere the model was off (share of the gap)\n";
    if (std::none_of(d.where.begin(), d.where.end(), [](const auto& w) { return w.share > 0; })) out += "  nowhere beyond the noise\n";
    else for (const auto& w : d.where) out += fmt::format("  {:5.1f} %  {}, {:.4g} s to {:.4g} s, {}\n", 100 * w.share, w.equation, w.from_s, w.to_s, w.region);
    for (const auto& r : d.recordings) {
        if (d.recordings.size() > 1) out += fmt::format("\n{}: gain {:.3g} [1]", r.file, r.gain);
        out += fmt::format("\n{:<12} {:>12} {:>12} {:>12}\n", "signal", "before [1]", "after [1]", "floor [1]");
        for (const auto& o : r.outputs) out += fmt::format("{:<12} {:>12.4g} {:>12.4g} {:>12.4g}\n", o.signal, o.before, o.after, o.floor);
    }
    if (!d.parameters_before.empty()) out += "\nparameters, refitted to the model as it was\n";
    for (const auto& p : d.parameters_before) out += fmt::format("  {}\n", with_deviation(p));
    if (!d.effects.empty()) {
        out += fmt::format("parameters of the amended model{}\n", one_of_several ? ", where one of several effects stands" : "");
        for (const auto& p : d.parameters_after) out += fmt::format("  {}\n", with_deviation(p));
    }
    out += fmt::format("\nreport: {}\n", report_file);
    return out;
}

}  // namespace algest::cli
