// SPDX-License-Identifier: GPL-3.0-or-later
// algest simulate: a free run of a model beside the recording of its machine.
#include "lab/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "cli/output_file.hpp"
#include "cli/progress.hpp"
#include "lab/simulate_report.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// NAME=VALUE, each name once; nullopt and an error for anything else.
std::optional<std::map<std::string, double>> settings(const std::vector<std::string>& texts, Diagnostics& diagnostics) {
    std::map<std::string, double> out;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        double value = 0;
        const char* end = text.data() + text.size();
        const auto read = equals == std::string::npos ? std::from_chars_result{end, std::errc::invalid_argument} : std::from_chars(text.data() + equals + 1, end, value);
        const bool number = read.ec == std::errc() && read.ptr == end;
        if (!number || !std::isfinite(value) || !out.emplace(text.substr(0, equals), value).second) {
            diagnostics.error("algest simulate", {}, "--set " + text + " is not NAME=VALUE with a finite number, each name once", "e.g. --set R=3.01");
            return std::nullopt;
        }
    }
    return out;
}

ordered_json outputs_json(const SimulateOptions& options, const model::Model& model, const std::vector<lab::OutputError>& outputs) {
    ordered_json list = ordered_json::array();
    for (const lab::OutputError& o : outputs) {
        const model::Signal& signal = model.signals[static_cast<std::size_t>(o.signal)];
        list.push_back({{"signal", signal.name}, {"unit", signal.unit}, {"rmse", o.rmse}, {"nrmse", o.nrmse}});
    }
    return {{"model", options.model}, {"recording", options.recording}, {"outputs", std::move(list)}};
}

std::string outputs_text(const model::Model& model, const std::vector<lab::OutputError>& outputs) {
    std::size_t width = std::string("signal").size();
    for (const lab::OutputError& o : outputs) width = std::max(width, model.signals[static_cast<std::size_t>(o.signal)].name.size());
    std::string out = fmt::format("{:<{}}  {:>12}  {:>10}  {}\n", "signal", width, "rmse", "nrmse [1]", "unit of rmse");
    for (const lab::OutputError& o : outputs) {
        const model::Signal& signal = model.signals[static_cast<std::size_t>(o.signal)];
        out += fmt::format("{:<{}}  {:>12.6g}  {:>10.4g}  {}\n", signal.name, width, o.rmse, o.nrmse, signal.unit);
    }
    return out;
}

}  // namespace

int simulate(const SimulateOptions& options) {
    Diagnostics diagnostics;
    if (outputs_collide({options.output, options.report}, {options.model, options.recording}, diagnostics)) return fail(diagnostics, options.json);
    const auto set = settings(options.set, diagnostics);
    if (!set) return fail(diagnostics, options.json);
    const auto model = model::read(options.model, false, diagnostics);
    const auto recording = lab::read_recording(options.recording, diagnostics, options.csv);
    if (!model || !recording) return fail(diagnostics, options.json);
    const auto bench = lab::bench(*model, *recording, diagnostics);
    const auto parameters = lab::parameter_values(*model, *set, diagnostics);
    if (!bench || !parameters) return fail(diagnostics, options.json);

    const lab::FreeRun run = [&] {
        ProgressLine progress("simulate");
        return lab::free_run(bench->system, *parameters, bench->initial, bench->drive, bench->options, [&](double share) { progress.show(share); });
    }();
    std::vector<lab::NewFile> files;
    if (!options.output.empty()) files.push_back({options.output, lab::run_csv(*model, *recording, run)});
    if (!options.report.empty()) {
        lab::Simulation simulation{*model, *recording, *bench, *parameters, {}, run};
        for (const auto& [name, value] : *set) simulation.given.insert(name);
        files.push_back({options.report, lab::simulate_report(simulation, {options.model, options.recording, options.command}, lab::gnuplot, diagnostics)});
    }
    if (!lab::write_files(files, diagnostics)) return fail(diagnostics, options.json);
    print_diagnostics(diagnostics);
    for (const std::string& written : {options.output, options.report}) if (!written.empty()) note("wrote " + written);
    if (run.samples < recording->samples()) {
        const std::string what = fmt::format("the free run diverges after {:.6g} s", recording->t[run.samples - 1]);
        const std::string right = "check signs and parameters; an unstable plant needs its [[feedback]] law";
        Diagnostics divergence;
        divergence.error(options.model, {}, what, right);
        (void)fail(divergence, options.json);
        return exit_no;
    }
    const auto outputs = lab::output_errors(*model, *bench, run, 0, run.samples);
    if (options.json) print_json(outputs_json(options, *model, outputs));
    else print(outputs_text(*model, outputs));
    return exit_done;
}

}  // namespace algest::cli
