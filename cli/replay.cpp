// SPDX-License-Identifier: GPL-3.0-or-later
// algest replay: the estimator of a model over a recording.
#include "lab/replay.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "cli/output_file.hpp"
#include "cli/progress.hpp"
#include "cli/replay_answer.hpp"
#include "cli/replay_remarks.hpp"
#include "generator/generate.hpp"
#include "lab/replay_report.hpp"
#include "lab/scatter.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

/// The stretch to replay; nullopt, and an error, where the options contradict each other.
std::optional<lab::Stretch> checked_stretch(const ReplayOptions& options, Diagnostics& diagnostics) {
    const auto refuse = [&](const std::string& what, const std::string& right) { diagnostics.error("algest replay", {}, what, right); };
    lab::Stretch stretch;
    stretch.from = options.from.value_or(stretch.from);
    stretch.to = options.to.value_or(stretch.to);
    if (!(stretch.from < stretch.to)) refuse(fmt::format("--from {} is not before --to {}", stretch.from, stretch.to), "two instants of the recording's `t`, in s");
    const bool writes = !options.output.empty() || !options.report.empty();
    if (options.batch && writes) refuse("-o and --report show what an estimator says at every sample, and --batch has one answer", "one of the two");
    if (options.recordings.size() > 1 && (writes || options.batch)) refuse("-o, --report and --batch are of one recording, and there are several", "one recording at a time");
    if (diagnostics.has_errors()) return std::nullopt;
    return stretch;
}

/// Runs it, with progress on a terminal.
std::optional<lab::Replay> run(const ReplayOptions& options, const plan::Plan& plan, const lab::Recording& recording, const lab::Stretch& stretch, Diagnostics& diagnostics) {
    constexpr std::size_t deviations_over_time = 500;
    auto replay = [&] {
        ProgressLine progress("replay");
        return lab::replay(plan, recording, stretch, diagnostics, [&](double share) { progress.show(share); });
    }();
    if (!replay) return std::nullopt;
    ProgressLine progress("standard deviations");
    const bool over_time = !options.output.empty() || !options.report.empty();
    lab::add_deviations(plan, recording, over_time ? deviations_over_time : lab::deviations_for_scatter, *replay, [&](double share) { progress.show(share); });
    return replay;
}

/// What -o and --report ask for; false, and an error, where it cannot be made. doubts: for the page.
bool write_outputs(const ReplayOptions& options, const plan::Plan& plan, const lab::Recording& recording, const lab::Replay& replay, const lab::ReplaySummary& summary,
                   const std::vector<std::string>& doubts, Diagnostics& diagnostics) {
    std::vector<lab::NewFile> files;
    if (!options.output.empty()) files.push_back({options.output, lab::replay_csv(plan, replay)});
    if (!options.report.empty()) {
        Diagnostics said_before;   // by plan_from_model, of the same file
        const auto model = model::read(options.model, false, said_before);
        if (!model) return false;
        const lab::Replayed replayed{plan, *model, recording, replay, summary, generator::derivation_latex(plan), doubts};
        files.push_back({options.report, lab::replay_report(replayed, {options.model, options.recordings[0], options.command}, lab::gnuplot, diagnostics)});
    }
    return lab::write_files(files, diagnostics);
}

}  // namespace

plan::Scalar scalar_of(const ReplayOptions& options) { return options.scalar == "float" ? plan::Scalar::float32 : plan::Scalar::float64; }

int replay(const ReplayOptions& options) {
    Diagnostics diagnostics;
    std::vector<std::string> inputs = options.recordings;
    inputs.push_back(options.model);
    if (outputs_collide({options.output, options.report}, inputs, diagnostics)) return fail(diagnostics, options.json);
    const auto stretch = checked_stretch(options, diagnostics);
    if (!stretch) return fail(diagnostics, options.json);
    if (options.batch) return replay_batch(options, *stretch);
    if (options.recordings.size() > 1) return replay_several(options, *stretch);

    const auto plan = generator::plan_from_model(options.model, {scalar_of(options), {}}, diagnostics);
    const auto recording = lab::read_recording(options.recordings[0], diagnostics, options.csv);
    if (!plan || !recording) return fail(diagnostics, options.json);
    for (const std::string& text : plan->notes) diagnostics.note(options.model, text);
    const auto replay = run(options, *plan, *recording, *stretch, diagnostics);
    if (!replay) return fail(diagnostics, options.json);
    const lab::ReplaySummary summary = lab::summarise(*replay);
    Diagnostics remarks;
    add_remarks(options.model, *plan, *recording, *stretch, *replay, summary, remarks);
    const auto lacks = what_it_lacks(options.model, options.recordings[0], *plan, *replay, summary);
    std::vector<std::string> doubts = texts_of(remarks);
    if (lacks) doubts.push_back(*lacks);
    if (!write_outputs(options, *plan, *recording, *replay, summary, doubts, diagnostics)) return fail(diagnostics, options.json);
    print_diagnostics(diagnostics);
    print_diagnostics(remarks);
    for (const std::string& written : {options.output, options.report}) if (!written.empty()) note("wrote " + written);

    if (lacks) note(*lacks);
    if (options.json) {
        nlohmann::ordered_json answer = replay_json(options.model, options.recordings[0], *plan, *replay, summary);
        answer["notes"] = texts_of(remarks);
        print_json(answer);
    } else print(replay_text(*plan, *replay, summary));
    return exit_done;
}

}  // namespace algest::cli
