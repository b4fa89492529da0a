// SPDX-License-Identifier: GPL-3.0-or-later
// algest discover: where model and recording disagree, the name of what is missing, the amended model.
#include "lab/discover.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "cli/progress.hpp"
#include "generator/generate.hpp"
#include "generator/source_text.hpp"
#include "lab/report.hpp"
#include "lab/simulate.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// "A:B" as two finite numbers, A < B; nullopt and an error for anything else.
std::optional<std::pair<double, double>> stretch(const std::string& option, const std::string& text, Diagnostics& diagnostics) {
    double from = 0;
    double to = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, from);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == ':') {
        const auto second = std::from_chars(first.ptr + 1, end, to);
        if (second.ec == std::errc() && second.ptr == end && std::isfinite(from) && std::isfinite(to) && from < to) return std::pair(from, to);
    }
    diagnostics.error("algest discover", {}, option + " " + text + " is not A:B in seconds with A before B", "e.g. " + option + " 0:7");
    return std::nullopt;
}

/// The library beside the program (a build tree or an installation), and a folder beside the model.
std::vector<std::string> effect_folders(const std::string& model) {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    const std::filesystem::path beside = std::filesystem::absolute(model, error).parent_path() / "effects";
    return {(program / "../share/algest/models/effects").string(), (program / "../models/effects").string(), beside.string()};
}

ordered_json effect_json(const lab::NamedEffect& effect) {
    ordered_json parameters = ordered_json::array();
    for (const lab::NamedParameter& p : effect.parameters) {
        parameters.push_back({{"name", p.name}, {"unit", p.unit}, {"value", p.value}, {"sd", std::isfinite(p.sd) ? ordered_json(p.sd) : ordered_json(nullptr)}});
    }
    return {{"name", effect.name}, {"equation", effect.equation}, {"term", effect.term}, {"parameters", std::move(parameters)}};
}

ordered_json discovery_json(const lab::Discovery& d, const std::string& model_file, const std::string& patch_file, const std::string& report_file) {
    ordered_json out;
    out["verdict"] = lab::name(d.verdict);
    out["effects"] = ordered_json::array();
    for (const auto& e : d.effects) out["effects"].push_back(effect_json(e));
    out["alternatives"] = d.alternatives;
    out["experiments"] = d.experiments;
    out["doubts"] = d.doubts;
    out["where"] = ordered_json::array();
    for (const auto& w : d.where) out["where"].push_back({{"equation", w.equation}, {"share", w.share}, {"from_s", w.from_s}, {"to_s", w.to_s}, {"region", w.region}});
    out["outputs"] = ordered_json::array();
    for (const auto& o : d.outputs) out["outputs"].push_back({{"signal", o.signal}, {"nrmse_before", o.before}, {"nrmse_after", o.after}, {"noise_floor", o.floor}});
    out["model"] = model_file.empty() ? ordered_json(nullptr) : ordered_json(model_file);
    out["patch"] = patch_file.empty() ? ordered_json(nullptr) : ordered_json(patch_file);
    out["report"] = report_file;
    return out;
}

std::string discovery_text(const lab::Discovery& d, const std::string& report_file) {
    std::string out = fmt::format("verdict: {}\n", lab::name(d.verdict));
    for (const auto& e : d.effects) {
        out += fmt::format("  {} in {}: {}\n", e.name, e.equation, e.term);
        for (const auto& p : e.parameters) out += fmt::format("    {} = {:.6g} +- {:.2g} {}\n", p.name, p.value, p.sd, p.unit);
    }
    for (const auto& a : d.alternatives) out += fmt::format("  the data allow: {}\n", fmt::join(a, ", "));
    for (const auto& e : d.experiments) out += fmt::format("  to tell: {}\n", e);
    for (const auto& e : d.doubts) out += fmt::format("  doubt: {}\n", e);
    if (!d.evidence.empty()) out += fmt::format("\n{:<4} {:<22} {:<28} {:>12} {:>14} {:>12}\n", "step", "effect", "equation", "strength [1]", "validation [1]", "gain [1]");
    for (const auto& e : d.evidence) {
        out += fmt::format("{:<4} {:<22} {:<28} {:>12.3g} {:>14.4g} {:>12.3g}{}\n", e.step, e.effect, e.equation, e.strength, e.validation, e.improvement, e.chosen ? "  chosen" : e.rival ? "  rival" : "");
    }
    out += "\nwhere the model was off (share of the gap)\n";
    for (const auto& w : d.where) out += fmt::format("  {:5.1f} %  {}, {:.4g} s to {:.4g} s, {}\n", 100 * w.share, w.equation, w.from_s, w.to_s, w.region);
    out += fmt::format("\n{:<12} {:>12} {:>12} {:>12}\n", "signal", "before [1]", "after [1]", "floor [1]");
    for (const auto& o : d.outputs) out += fmt::format("{:<12} {:>12.4g} {:>12.4g} {:>12.4g}\n", o.signal, o.before, o.after, o.floor);
    out += fmt::format("\nreport: {}\n", report_file);
    return out;
}

struct OutputFiles {
    std::string before;
    std::string after;
    std::string model;
    std::string patch;
    std::string report;
};

OutputFiles output_files(const DiscoverOptions& options) {
    const std::filesystem::path directory = options.directory;
    const std::string stem = std::filesystem::path(options.model).stem().string();
    const auto in = [&](const std::string& name) { return (directory / name).string(); };
    return {in("before.csv"), in("after.csv"), in(stem + ".toml"), in(stem + ".patch"), in("report.html")};
}

/// False, and an error, where an output would take the place of the model or the recording.
bool keeps_inputs(const OutputFiles& files, const DiscoverOptions& options, Diagnostics& diagnostics) {
    for (const std::string& input : {options.model, options.recording}) {
        for (const std::string& output : {files.before, files.after, files.model, files.patch, files.report}) {
            std::error_code error;
            if (!std::filesystem::equivalent(input, output, error)) continue;
            diagnostics.error(input, {}, "would be overwritten by a file of the same name in -o " + options.directory, "choose another folder for -o");
            return false;
        }
    }
    return true;
}

}  // namespace

int discover(const DiscoverOptions& options) {
    Diagnostics diagnostics;
    lab::DiscoverOptions stretches;
    if (!options.train.empty()) stretches.train_s = stretch("--train", options.train, diagnostics);
    if (!options.test.empty()) stretches.test_s = stretch("--test", options.test, diagnostics);
    if (diagnostics.has_errors()) return fail(diagnostics, options.json);
    const auto text = model::read_text(options.model, 1024 * 1024, diagnostics);
    const auto recording = lab::read_recording(options.recording, diagnostics, options.csv);
    const auto effects = lab::read_effects(effect_folders(options.model), diagnostics);
    if (effects.empty() && !diagnostics.has_errors()) {
        diagnostics.error("algest discover", {}, "no library of effects beside the program", "install algest, run build/algest, or put a folder `effects` beside the model");
    }
    if (!text || !recording || diagnostics.has_errors()) return fail(diagnostics, options.json);

    const OutputFiles files = output_files(options);
    if (!keeps_inputs(files, options, diagnostics)) return fail(diagnostics, options.json);

    const auto found = [&] {
        ProgressLine progress("discover");
        return lab::discover(*text, options.model, *recording, effects, stretches, diagnostics, [&](const std::string&, double share) { progress.show(share); });
    }();
    if (!found) return fail(diagnostics, options.json);
    const auto model = model::read_from_text(*text, options.model, false, diagnostics);

    const bool amended = found->model_text != *text;
    const std::string model_file = amended ? files.model : "";
    const std::string patch_file = amended ? files.patch : "";
    const std::string patch = amended ? generator::unified_diff(options.model, *text, options.model, found->model_text) : "";
    std::error_code error;
    std::filesystem::create_directories(options.directory, error);
    const auto write = [&](const std::string& path, const std::string& content) { return lab::write_file(path, content, diagnostics); };
    const lab::ReportFiles named{options.model, options.recording, options.directory, model_file, patch_file, patch};
    bool written = write(files.before, lab::run_csv(*model, *recording, found->before)) && write(files.after, lab::run_csv(*model, *recording, found->after));
    if (written && amended) written = write(patch_file, patch) && write(model_file, found->model_text);
    written = written && write(files.report, lab::report_html(*found, *model, *recording, named, lab::gnuplot, diagnostics));
    if (written && amended && options.apply) written = write(options.model, found->model_text);   // the user's own file last, when all else stands
    if (!written) return fail(diagnostics, options.json);
    print_diagnostics(diagnostics);
    if (options.json) print_json(discovery_json(*found, model_file, patch_file, files.report));
    else print(discovery_text(*found, files.report));
    return exit_done;
}

}  // namespace algest::cli
