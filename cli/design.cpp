// SPDX-License-Identifier: GPL-3.0-or-later
// algest design: which window, rows, kappa and engine suit a recording.
#include "lab/design.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "cli/progress.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

ordered_json trial_json(const model::Model& model, const lab::Trial& t) {
    ordered_json parameters = ordered_json::array();
    for (std::size_t p = 0; p < t.mean.size(); ++p) parameters.push_back({{"name", model.parameters[p].name}, {"mean", t.mean[p]}, {"scatter", t.scatter[p]}});
    return {{"window_s", t.window_s}, {"kappa", t.kappa}, {"rows", t.rows}, {"engine", t.engine.engine}, {"multiply_adds", t.engine.multiply_adds}, {"ok", t.ok},
            {"noise", t.noise}, {"perturbation", t.perturbation}, {"error", t.error}, {"parameters", std::move(parameters)}};
}

ordered_json trials_json(const model::Model& model, const std::vector<lab::Trial>& trials) {
    ordered_json out = ordered_json::array();
    for (const lab::Trial& t : trials) out.push_back(trial_json(model, t));
    return out;
}

ordered_json design_json(const DesignOptions& options, const model::Model& model, const lab::Design& design) {
    ordered_json reference = ordered_json::array();
    for (std::size_t p = 0; p < model.parameters.size(); ++p) {
        reference.push_back({{"name", model.parameters[p].name}, {"unit", model.parameters[p].unit}, {"value", design.recommended ? ordered_json(design.reference.values[p]) : ordered_json(nullptr)}, {"counts", bool(design.reference.counts[p])}});
    }
    return {{"model", options.model}, {"recording", options.recording},
            {"reference", {{"free_run", design.reference.free_run}, {"parameters", std::move(reference)}}},
            {"accuracy", options.accuracy ? ordered_json(*options.accuracy) : ordered_json(nullptr)}, {"reached", design.reached},
            {"recommended", design.recommended ? trial_json(model, *design.recommended) : ordered_json(nullptr)},
            {"curve", trials_json(model, design.curve)}, {"others", trials_json(model, design.others)}, {"missing", design.missing}};
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string row_text(const lab::Trial& t, const std::string& mark) {
    return fmt::format("{:>10.6g}  {:>10}  {:>12}  {:>10}  {:>7}  {}{}\n", t.window_s, percent(t.noise), percent(t.perturbation), percent(t.error), percent(t.ok), t.engine.engine, mark);
}

bool same_rows(const lab::Trial& a, const lab::Trial& b) { return a.kappa == b.kappa && a.rows == b.rows; }

/// The model as it is, and what is recommended where that has another kappa or more rows.
std::string curve_text(const lab::Design& design) {
    std::string out = fmt::format("{:>10}  {:>10}  {:>12}  {:>10}  {:>7}  {}\n", "window [s]", "noise", "perturbation", "error", "ok", "engine");
    const lab::Trial* best = design.recommended ? &*design.recommended : nullptr;
    for (const lab::Trial& t : design.curve) out += row_text(t, best != nullptr && t.window_s == best->window_s && same_rows(t, *best) ? "  <-" : "");
    if (best != nullptr && (design.curve.empty() || !same_rows(*best, design.curve.front()))) out += "with the kappa and rows that are recommended below:\n" + row_text(*best, "  <-");
    return out;
}

std::string numbers(const std::vector<int>& of) {
    std::string out;
    for (const int n : of) out += (out.empty() ? "" : ", ") + std::to_string(n);
    return out;
}

/// The table is of the model as it is: what it says of the recommended window, where kappa or rows are to be others.
std::string beside_the_table(const lab::Design& design) {
    const lab::Trial& best = *design.recommended;
    for (const lab::Trial& t : design.curve) {
        if (t.window_s == best.window_s && !same_rows(t, best)) return fmt::format("; with the model's own kappa and rows {}", percent(t.error));
    }
    return "";
}

std::string recommendation_text(const model::Model& model, const lab::Design& design) {
    const lab::Trial& t = *design.recommended;
    std::string out = fmt::format("\nrecommended: window = {:.6g}, engine = \"{}\" ({} multiply-adds a sample), error {}{}\n", t.window_s, t.engine.engine, t.engine.multiply_adds, percent(t.error), beside_the_table(design));
    for (std::size_t e = 0; e < model.equations.size(); ++e) {
        if (!t.rows[e].empty()) out += fmt::format("  {}: kappa = {}, rows = [{}]\n", model.equations[e].name, t.kappa[e], numbers(t.rows[e]));
    }
    return out;
}

std::string reference_text(const model::Model& model, const lab::Design& design) {
    std::string out = design.reference.free_run ? "\ncompared with the free run's fit:" : "\ncompared with the consensus of the windows (the free run does not follow to the noise):";
    for (std::size_t p = 0; p < model.parameters.size(); ++p) {
        out += fmt::format("{} {} = {:.6g} {}{}", p == 0 ? "" : ",", model.parameters[p].name, design.reference.values[p], model.parameters[p].unit, design.reference.counts[p] ? "" : " (too near to zero to count)");
    }
    return out + "\n";
}

std::string design_text(const model::Model& model, const DesignOptions& options, const lab::Design& design) {
    std::string out = design.curve.empty() ? "" : curve_text(design);
    if (design.recommended) out += reference_text(model, design);
    out += design.recommended ? recommendation_text(model, design) : "no window gives an estimate on this recording that rises above its own scatter\n";
    if (!design.reached && design.recommended) {
        out += options.accuracy ? fmt::format("the accuracy {} is out of reach\n", percent(*options.accuracy))
                                : fmt::format("no window is of use: the least error is {}\n", percent(design.recommended->error));
    }
    for (const std::string& text : design.missing) out += "missing: " + text + "\n";
    return out;
}
}  // namespace

int design(const DesignOptions& options) {
    Diagnostics diagnostics;
    const auto model = model::read(options.model, false, diagnostics);
    const auto recording = lab::read_recording(options.recording, diagnostics, options.csv);
    if (!model || !recording) return fail(diagnostics, options.json);
    const auto design = [&] {
        ProgressLine progress("design");
        return lab::design(*model, *recording, {options.accuracy}, diagnostics, [&](double share) { progress.show(share); });
    }();
    if (!design) return fail(diagnostics, options.json);
    print_diagnostics(diagnostics);
    if (options.json) print_json(design_json(options, *model, *design));
    else print(design_text(*model, options, *design));
    return design->reached ? exit_done : exit_no;
}

}  // namespace algest::cli
