// SPDX-License-Identifier: GPL-3.0-or-later
// algest replay --batch: all rows of a recording at once, and what the recording cannot tell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "generator/generate.hpp"
#include "lab/batch.hpp"
#include "lab/doubt.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(std::optional<double> value) { return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr); }

using Doubts = std::vector<std::optional<std::string>>;

/// Of each parameter of the batch, by its declaration in the model.
Doubts doubts(const model::Model& model, const plan::Plan& plan, const lab::Batch& batch) {
    Doubts out(batch.parameters.size());
    for (std::size_t p = 0; p < out.size(); ++p) {
        const auto declared = std::find_if(model.parameters.begin(), model.parameters.end(), [&](const model::Parameter& d) { return d.name == plan.parameters[p].name; });
        const lab::BatchParameter& found = batch.parameters[p];
        if (found.value && declared != model.parameters.end()) out[p] = lab::doubt(*declared, *found.value, found.deviation);
    }
    return out;
}

ordered_json batch_json(const ReplayOptions& options, const plan::Plan& plan, const lab::Batch& batch, const Doubts& doubts) {
    ordered_json parameters = ordered_json::array();
    for (std::size_t p = 0; p < batch.parameters.size(); ++p) {
        parameters.push_back({{"name", plan.parameters[p].name},
                              {"unit", plan.parameters[p].unit},
                              {"value", number_or_null(batch.parameters[p].value)},
                              {"sd", number_or_null(batch.parameters[p].deviation)},
                              {"doubt", doubts[p] ? ordered_json(*doubts[p]) : ordered_json(nullptr)}});
    }
    ordered_json confusions = ordered_json::array();
    for (const lab::Confusion& c : batch.confusions) confusions.push_back({{"unknowns", c.unknowns}, {"hardly", c.hardly}, {"text", c.text()}});
    return {{"model", options.model},
            {"recording", options.recordings[0]},
            {"samples", batch.samples},
            {"uniform", batch.uniform},
            {"instants", batch.instants},
            {"parameters", std::move(parameters)},
            {"condition", number_or_null(batch.condition)},
            {"correlated_instants", batch.memory},
            {"confused", std::move(confusions)}};
}

std::string batch_text(const plan::Plan& plan, const lab::Batch& batch, const Doubts& doubts) {
    std::size_t width = std::string("parameter").size();
    for (const plan::Parameter& p : plan.parameters) width = std::max(width, p.name.size());
    const auto text = [](std::optional<double> value) { return value ? fmt::format("{:.6g}", *value) : "-"; };
    std::string out = fmt::format("{:<{}}  {:>12}  {:>12}  unit\n", "parameter", width, "value", "sd");
    for (std::size_t p = 0; p < batch.parameters.size(); ++p) {
        out += fmt::format("{:<{}}  {:>12}  {:>12}  {}\n", plan.parameters[p].name, width, text(batch.parameters[p].value), text(batch.parameters[p].deviation), plan.parameters[p].unit);
    }
    out += fmt::format("\n{} samples, rows of {} instants; condition {:.6g}; residuals correlated over {:.3g} instants\n", batch.samples, batch.instants, batch.condition, batch.memory);
    for (const lab::Confusion& c : batch.confusions) out += (c.hardly ? "hardly identifiable from this recording: " : "not identifiable from this recording: ") + c.text() + "\n";
    for (const auto& d : doubts) if (d) out += "doubtful: " + *d + "\n";
    return out;
}

}  // namespace

int replay_batch(const ReplayOptions& options, const lab::Stretch& stretch) {
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(options.model, {}, diagnostics);
    const auto recording = lab::read_recording(options.recordings[0], diagnostics, options.csv, lab::TimeBase::increasing);
    if (!plan || !recording) return fail(diagnostics, options.json);
    Diagnostics said_before;   // by plan_from_model, of the same file
    const auto model = model::read(options.model, false, said_before);
    if (!model) return fail(said_before, options.json);
    const auto batch = lab::batch(*plan, *recording, stretch, diagnostics);
    if (!batch) return fail(diagnostics, options.json);
    for (const std::string& text : plan->notes) diagnostics.note(options.model, text);
    print_diagnostics(diagnostics);
    const Doubts against = doubts(*model, *plan, *batch);
    if (options.json) print_json(batch_json(options, *plan, *batch, against));
    else print(batch_text(*plan, *batch, against));
    return batch->determined() ? exit_done : exit_no;
}

}  // namespace algest::cli
