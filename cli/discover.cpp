// SPDX-License-Identifier: GPL-3.0-or-later
// algest discover: where model and recording disagree, the name of what is missing, the amended model.
#include "lab/discover.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/discovery_answer.hpp"
#include "cli/messages.hpp"
#include "cli/progress.hpp"
#include "generator/generate.hpp"
#include "generator/source_text.hpp"
#include "generator/toml_file.hpp"
#include "lab/report.hpp"
#include "lab/simulate.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

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

DiscoveryFiles output_files(const DiscoverOptions& options) {
    const std::filesystem::path directory = options.directory;
    const std::string stem = std::filesystem::path(options.model).stem().string();
    const auto in = [&](const std::string& name) { return (directory / name).string(); };
    DiscoveryFiles out{{}, {}, in(stem + ".toml"), in(stem + ".patch"), in("report.html")};
    for (std::size_t k = 1; k <= options.recordings.size(); ++k) {
        const std::string number = k == 1 ? "" : "_" + std::to_string(k);
        out.before.push_back(in("before" + number + ".csv"));
        out.after.push_back(in("after" + number + ".csv"));
    }
    return out;
}

/// False, and an error, where an output would take the place of the model or the recording.
bool keeps_inputs(const DiscoveryFiles& files, const DiscoverOptions& options, Diagnostics& diagnostics) {
    std::vector<std::string> inputs = options.recordings;
    inputs.push_back(options.model);
    for (const std::string& input : inputs) {
        for (const std::string& output : files.all()) {
            std::error_code error;
            if (!std::filesystem::equivalent(input, output, error)) continue;
            diagnostics.error(input, {}, "would be overwritten by a file of the same name in -o " + options.directory, "choose another folder for -o");
            return false;
        }
    }
    return true;
}

/// Asked before the search, so that its work is not in vain: of the folder, or of the nearest one above that exists.
bool can_hold_files(const std::string& directory, Diagnostics& diagnostics) {
    std::error_code error;
    std::filesystem::path there = std::filesystem::absolute(directory, error);
    while (!std::filesystem::exists(there, error) && there.has_relative_path()) there = there.parent_path();
    if (std::filesystem::is_directory(there, error) && ::access(there.c_str(), W_OK | X_OK) == 0) return true;
    diagnostics.error(directory, {}, "no folder that can be written into", "choose another one for -o");
    return false;
}

/// Each once: a recording that is given twice would count twice.
std::vector<lab::Recording> read_recordings(const DiscoverOptions& options, Diagnostics& diagnostics) {
    const std::vector<std::string>& paths = options.recordings;
    std::vector<lab::Recording> out;
    for (std::size_t k = 0; k < paths.size(); ++k) {
        std::error_code error;
        const bool twice = std::any_of(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(k), [&](const std::string& other) { return std::filesystem::equivalent(paths[k], other, error); });
        if (twice) diagnostics.error(paths[k], {}, "the same recording twice", "give each once");
        auto recording = lab::read_recording(paths[k], diagnostics, options.csv);
        if (recording) out.push_back(std::move(*recording));
    }
    return out;
}

}  // namespace

int discover(const DiscoverOptions& options) {
    Diagnostics diagnostics;
    lab::DiscoverOptions stretches;
    if (!options.train.empty()) stretches.train_s = stretch("--train", options.train, diagnostics);
    if (!options.test.empty()) stretches.test_s = stretch("--test", options.test, diagnostics);
    if (diagnostics.has_errors()) return fail(diagnostics, options.json);
    const auto text = model::read_text(options.model, model::largest_file, diagnostics);
    const std::vector<lab::Recording> recordings = read_recordings(options, diagnostics);
    const auto folders = effect_folders(options.model);
    const auto effects = lab::read_effects(folders, diagnostics);
    if (effects.empty() && !diagnostics.has_errors()) {
        diagnostics.error("algest discover", {}, fmt::format("no effects in {}", fmt::join(folders, ", nor in ")), "install algest, run build/algest, or put a folder `effects` beside the model");
    }
    if (!text || diagnostics.has_errors()) return fail(diagnostics, options.json);

    const DiscoveryFiles files = output_files(options);
    if (!keeps_inputs(files, options, diagnostics) || !can_hold_files(options.directory, diagnostics)) return fail(diagnostics, options.json);

    const auto found = [&] {
        ProgressLine progress("discover");
        return lab::discover(*text, options.model, recordings, effects, stretches, diagnostics, [&](const std::string&, double share) { progress.show(share); });
    }();
    if (!found) return fail(diagnostics, options.json);
    const auto model = model::read_from_text(*text, options.model, false, diagnostics);

    const bool amended = found->model_text != *text;
    const std::string patch = amended ? generator::unified_diff(options.model, *text, options.model, found->model_text) : "";
    const lab::ReportFiles named{options.model, options.recordings, options.directory, amended ? files.model : "", amended ? files.patch : "", patch};
    const auto with_effects = model::read_from_text(found->model_text, options.model, false, diagnostics);
    if (!with_effects) return fail(diagnostics, options.json);
    std::vector<lab::NewFile> written = {{files.report, lab::report_html(*found, *model, recordings[0], named, lab::gnuplot, diagnostics)}};
    for (std::size_t k = 0; k < recordings.size(); ++k) {
        written.push_back({files.before[k], lab::run_csv(*model, recordings[k], found->recordings[k].before)});
        written.push_back({files.after[k], lab::run_csv(*with_effects, recordings[k], found->recordings[k].after)});
    }
    const bool applied = options.apply && found->verdict == lab::Verdict::named;
    if (amended) written.insert(written.end(), {{files.patch, patch}, {files.model, found->model_text}});
    if (amended && applied) written.push_back({options.model, found->model_text});
    std::error_code error;
    std::filesystem::create_directories(options.directory, error);   // where it cannot be, the files say so
    if (!lab::write_files(written, diagnostics)) return fail(diagnostics, options.json);
    if (!amended) for (const std::string& stale : {files.model, files.patch}) std::filesystem::remove(stale);   // of an earlier run, which this one takes back
    print_diagnostics(diagnostics);
    if (applied) note("wrote the amended model into " + options.model);
    else if (options.apply) note(fmt::format("--apply: the verdict is {}, so {} stays as it is", lab::name(found->verdict), options.model));
    if (options.json) print_json(discovery_json(*found, files, amended));
    else print(discovery_text(*found, files.report));
    return exit_done;
}

}  // namespace algest::cli
