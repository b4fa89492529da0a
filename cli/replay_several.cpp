// SPDX-License-Identifier: GPL-3.0-or-later
// algest replay of several recordings: a line each, failures last.
#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/jobs.hpp"
#include "cli/messages.hpp"
#include "cli/progress.hpp"
#include "cli/replay_answer.hpp"
#include "cli/replay_remarks.hpp"
#include "generator/generate.hpp"
#include "lab/scatter.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// replay_json of one recording, or {"recording", "error": [...]}; "messages" holds what is to be said on standard error.
ordered_json answer(const ReplayOptions& options, const plan::Plan& plan, const std::string& file, const lab::Stretch& stretch) {
    Diagnostics diagnostics;
    const auto recording = lab::read_recording(file, diagnostics, options.csv);
    auto replay = recording ? lab::replay(plan, *recording, stretch, diagnostics) : std::nullopt;
    if (replay) lab::add_deviations(plan, *recording, lab::deviations_for_scatter, *replay);
    const lab::ReplaySummary summary = replay ? lab::summarise(*replay) : lab::ReplaySummary();
    ordered_json notes;
    if (replay) {
        add_remarks(options.model, plan, *recording, stretch, *replay, summary, diagnostics);
        notes = texts_of(diagnostics);
        if (const auto lacks = what_it_lacks(options.model, file, plan, *replay, summary)) diagnostics.note(file, *lacks);
    }
    ordered_json out = replay ? replay_json(options.model, file, plan, *replay, summary) : ordered_json{{"recording", file}, {"error", errors_json(diagnostics)}};
    if (replay) out["notes"] = notes;
    out["messages"] = ordered_json::array();
    for (const Diagnostic& d : diagnostics.sorted()) out["messages"].push_back(d.text());
    return out;
}

ordered_json crash(const std::string& file) {
    Diagnostics diagnostics;
    diagnostics.error(file, {}, "a fault of algest itself: the process that replayed it ended", "please report it with the files it was given");
    return {{"recording", file}, {"error", errors_json(diagnostics)}, {"messages", {diagnostics.sorted()[0].text()}}};
}

bool failed(const ordered_json& answer) { return answer.contains("error"); }

std::size_t ok_samples(const ordered_json& answer) { return answer["status"]["ok"].get<std::size_t>(); }

/// 0: estimated, 1: replayed without one estimate, 2: failed.
int rank(const ordered_json& answer) { return failed(answer) ? 2 : ok_samples(answer) == 0 ? 1 : 0; }

std::string number(const ordered_json& value) { return value.is_null() ? "-" : fmt::format("{:.6g}", value.get<double>()); }

std::string heading(const plan::Parameter& p) { return p.unit.empty() ? p.name : p.name + " [" + p.unit + "]"; }

std::string table(const plan::Plan& plan, const std::vector<ordered_json>& answers) {
    std::size_t width = std::string("recording").size();
    for (const ordered_json& a : answers) width = std::max(width, a["recording"].get<std::string>().size());
    std::string out = fmt::format("{:<{}}", "recording", width);
    for (const plan::Parameter& p : plan.parameters) out += fmt::format("  {:>{}}", heading(p), std::max<std::size_t>(12, heading(p).size()));
    out += fmt::format("  {:>7}  {:>14}\n", "ok [%]", "condition [1]");
    for (const ordered_json& a : answers) {
        out += fmt::format("{:<{}}", a["recording"].get<std::string>(), width);
        if (failed(a)) {
            out += fmt::format("  failed: {}\n", a["error"][0]["what"].get<std::string>());
            continue;
        }
        for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
            out += fmt::format("  {:>{}}", number(a["parameters"][p]["median"]), std::max<std::size_t>(12, heading(plan.parameters[p]).size()));
        }
        const double share = 100.0 * static_cast<double>(ok_samples(a)) / a["samples"].get<double>();
        out += fmt::format("  {:>7.1f}  {:>14}\n", share, number(a["condition"]["median"]));
    }
    return out + "\nmedians over the samples with status ok\n";
}

}  // namespace

int replay_several(const ReplayOptions& options, const lab::Stretch& stretch) {
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(options.model, {scalar_of(options), {}}, diagnostics);
    if (!plan) return fail(diagnostics, options.json);
    for (const std::string& text : plan->notes) diagnostics.note(options.model, text);
    print_diagnostics(diagnostics);

    const std::size_t count = options.recordings.size();
    std::vector<ordered_json> answers;
    {
        ProgressLine progress("replay of several recordings");
        const auto texts = run_jobs(count, options.jobs > 0 ? static_cast<std::size_t>(options.jobs) : processors(),
                                    [&](std::size_t k) { return answer(options, *plan, options.recordings[k], stretch).dump(-1, ' ', false, ordered_json::error_handler_t::replace); },
                                    [&](std::size_t done) { progress.show(static_cast<double>(done) / static_cast<double>(count)); });
        for (std::size_t k = 0; k < count; ++k) answers.push_back(texts[k] ? ordered_json::parse(*texts[k]) : crash(options.recordings[k]));
    }
    std::stable_sort(answers.begin(), answers.end(), [](const ordered_json& a, const ordered_json& b) { return rank(a) < rank(b); });
    bool all = true;
    for (ordered_json& a : answers) {
        for (const ordered_json& message : a["messages"]) note(message.get<std::string>());
        a.erase("messages");
        all = all && !failed(a);
    }
    if (options.json) print_json({{"model", options.model}, {"recordings", answers}});
    else print(table(*plan, answers));
    return all ? exit_done : exit_bad_input;
}

}  // namespace algest::cli
