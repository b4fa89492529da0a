// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "lab/quantity.hpp"
#include "lab/report_figures.hpp"
#include "lab/report_page.hpp"

namespace algest::lab {

namespace {

using generator::Data;
using generator::DataList;

constexpr double called_the_floor = 1.2;       ///< error over floor up to which a reader is told that the gap is gone
constexpr std::size_t most_evidence = 40;      ///< rows of the table
constexpr std::size_t longest_in_a_sentence = 70;   ///< bytes of a term; a longer one gets a line of its own
constexpr double share_worth_a_line = 0.02;    ///< of the gap, in the verdict

Data parameter_data(const NamedParameter& p) {
    Data data;
    set_text(data, "parameter", p.name);
    set_text(data, "unit", unit_text(p.unit));
    set_quantity(data, "", p.value, p.sd);
    const double share = std::abs(p.sd / p.value);
    data.set("has_share", std::isfinite(share) && p.sd > 0);
    set_text(data, "share", fmt::format("{:.2g}", 100 * share));
    return data;
}

/// Error over floor; infinite without a floor.
double over_floor(double error, const OutputGap& output) { return output.floor > 0 ? error / output.floor : std::numeric_limits<double>::infinity(); }

/// The output whose error was furthest above its floor; null without outputs.
const OutputGap* worst(const Discovery& d) {
    const auto found = std::max_element(d.first().outputs.begin(), d.first().outputs.end(), [](const OutputGap& a, const OutputGap& b) {
        const double x = over_floor(a.before, a), y = over_floor(b.before, b);
        return std::isfinite(x) || std::isfinite(y) ? x < y : a.before < b.before;
    });
    return found == d.first().outputs.end() ? nullptr : &*found;
}

/// What the four cards at the head say of the gap: its size at the worst output.
void set_gap(Data& page, const Discovery& d) {
    const OutputGap* const output = worst(d);
    page.set("has_gap", output != nullptr);
    const OutputGap gap = output != nullptr ? *output : OutputGap{"", 0, 0, 0};
    const bool floored = gap.floor > 0;
    page.set("gap_floored", floored);
    set_text(page, "gap_signal", gap.signal);
    set_text(page, "gap_before", three_digits(floored ? gap.before / gap.floor : gap.before));
    set_text(page, "gap_after", three_digits(floored ? gap.after / gap.floor : gap.after));
    const double factor = gap.before / gap.after;
    page.set("gap_has_factor", std::isfinite(factor) && factor >= 1.05);
    set_text(page, "gap_factor", three_digits(factor));
    page.set("gap_was_at_floor", output != nullptr && floored && gap.before < called_the_floor * gap.floor);
    page.set("gap_is_at_floor", output != nullptr && floored && std::all_of(d.first().outputs.begin(), d.first().outputs.end(), [](const OutputGap& o) { return o.after < called_the_floor * o.floor; }));
}

/// How far behind the chosen effect the best one comes that was not chosen.
void set_runner_up(Data& page, const Discovery& d) {
    const Evidence* chosen = nullptr;
    const Evidence* next = nullptr;
    std::set<std::string> names;   // an effect that a later step chose is no rival of the first
    for (const Evidence& e : d.evidence) {
        if (!e.chosen) continue;
        if (chosen == nullptr) chosen = &e;
        names.insert(e.effect);
    }
    for (const Evidence& e : d.evidence) {
        if (chosen == nullptr || names.count(e.effect) > 0 || e.step != chosen->step || !std::isfinite(e.validation)) continue;
        if (next == nullptr || e.validation < next->validation) next = &e;
    }
    const bool known = chosen != nullptr && next != nullptr && chosen->validation > 0;
    page.set("has_runner_up", known);
    set_text(page, "runner_up", known ? next->effect : "");
    set_text(page, "runner_up_factor", known ? three_digits(next->validation / chosen->validation) : "");
    page.set("has_strength", chosen != nullptr);
    set_text(page, "strength", chosen != nullptr ? three_digits(chosen->strength) : "");
}

DataList effects_data(const Discovery& d) {
    DataList list;
    for (const NamedEffect& effect : d.effects) {
        Data data;
        set_text(data, "effect", effect.name);
        set_text(data, "equation", effect.equation);
        set_text(data, "term", effect.term);
        data.set("long_term", effect.term.size() > longest_in_a_sentence);
        set_text(data, "summary", effect.summary);
        data.set("has_summary", !effect.summary.empty());
        set_text(data, "shows", effect.shows);
        data.set("has_shows", !effect.shows.empty());
        DataList parameters;
        for (const NamedParameter& p : effect.parameters) parameters.push_back(parameter_data(p));
        set_list(data, "parameters", parameters);
        list.push_back(data);
    }
    return list;
}

DataList alternatives_data(const Discovery& d) {
    DataList list;
    for (const auto& alternative : d.alternatives) list.push_back(entry("alternative", fmt::format("{}", fmt::join(alternative, " and "))));
    return list;
}

DataList texts_data(const std::string& name, const std::vector<std::string>& texts) {
    DataList list;
    for (const std::string& text : texts) list.push_back(entry(name, text));
    return list;
}

DataList gaps_data(const Discovery& d) {
    DataList list;
    for (const OutputGap& output : d.first().outputs) {
        Data data;
        set_text(data, "signal", output.signal);
        set_text(data, "before", three_digits(output.before));
        set_text(data, "after", three_digits(output.after));
        set_text(data, "floor", output.floor > 0 ? three_digits(output.floor) : "-");
        set_text(data, "before_over", three_digits(over_floor(output.before, output)));
        set_text(data, "after_over", three_digits(over_floor(output.after, output)));
        data.set("closed", output.floor > 0 && output.after < called_the_floor * output.floor);
        list.push_back(data);
    }
    return list;
}

/// The gap of every output in every recording.
DataList recordings_data(const Discovery& d) {
    DataList list;
    for (const RecordingEvidence& r : d.recordings) {
        for (const OutputGap& output : r.outputs) {
            Data data;
            set_text(data, "file", r.file);
            set_text(data, "signal", output.signal);
            set_text(data, "before", three_digits(output.before));
            set_text(data, "after", three_digits(output.after));
            set_text(data, "floor", output.floor > 0 ? three_digits(output.floor) : "-");
            set_text(data, "gain", three_digits(r.gain));
            list.push_back(data);
        }
    }
    return list;
}

DataList tests_data(const Discovery& d, const model::Model& model, const Recording& recording, Figures& figures) {
    DataList list;
    for (const OutputGap& output : d.first().outputs) {
        const auto figure = test_figure(d, model, recording, output);
        if (!figure) continue;
        Data data;
        set_text(data, "signal", output.signal);
        set_text(data, "unit", unit_text(model.signal(output.signal)->unit));
        data.set("has_noise", figure->noise > 0);
        set_text(data, "noise", three_digits(figure->noise));
        data.set("detail", figure->detail);
        data.set("before_diverges", figure->diverges[0]);
        data.set("after_diverges", figure->diverges.size() > 1 && figure->diverges[1]);
        figures.set(data, figure->figure);
        list.push_back(data);
    }
    return list;
}

/// The equations' residuals over time, or against what explains them.
template <typename MakeFigure>
DataList residuals_data(const Discovery& d, Figures& figures, const MakeFigure& make_figure) {
    DataList list;
    for (const EquationResidual& residual : d.residuals) {
        const std::optional<Figure> figure = make_figure(residual);
        if (!figure) continue;
        Data data;
        set_text(data, "equation", residual.equation);
        set_text(data, "unit", unit_text(residual.unit));
        set_text(data, "signal", residual.signal);
        data.set("has_noise", std::isfinite(residual.noise) && residual.noise > 0);
        set_text(data, "noise", three_digits(residual.noise));
        data.set("has_after", residual.after.size() == residual.before.size());
        data.set("has_law", !residual.law.empty() && residual.law.size() == residual.after.size());
        figures.set(data, *figure);
        list.push_back(data);
    }
    return list;
}

DataList where_data(const Discovery& d) {
    DataList list;
    for (const Where& w : d.where) {
        Data data;
        set_text(data, "equation", w.equation);
        set_text(data, "share", fmt::format("{:.1f}", 100 * w.share));
        data.set("large", w.share >= share_worth_a_line);
        set_text(data, "bar", fmt::format("{:.1f}", std::isfinite(w.share) ? std::clamp(100 * w.share, 0.0, 100.0) : 0.0));
        set_text(data, "from_s", fmt::format("{:.4g}", w.from_s));
        set_text(data, "to_s", fmt::format("{:.4g}", w.to_s));
        set_text(data, "region", w.region);
        list.push_back(data);
    }
    return list;
}

DataList evidence_data(const Discovery& d) {
    DataList list;
    for (const Evidence& e : d.evidence) {
        if (list.size() >= most_evidence && !e.chosen && !e.rival) continue;
        Data data;
        set_text(data, "step", std::to_string(e.step));
        set_text(data, "effect", e.effect);
        set_text(data, "equation", e.equation);
        set_text(data, "term", e.term);
        set_text(data, "strength", three_digits(e.strength));
        set_text(data, "validation", three_digits(e.validation));
        set_text(data, "improvement", three_digits(e.improvement));
        data.set("chosen", e.chosen);
        data.set("rival", e.rival && !e.chosen);
        data.set("rejected", !e.rival && !e.chosen);
        list.push_back(data);
    }
    return list;
}

/// Both lists by name: first those of the nominal model, then what the effects bring.
DataList parameters_data(const Discovery& d) {
    const auto named = [](const std::vector<NamedParameter>& list, const std::string& name) {
        const auto found = std::find_if(list.begin(), list.end(), [&](const NamedParameter& p) { return p.name == name; });
        return found == list.end() ? nullptr : &*found;
    };
    std::vector<const NamedParameter*> order;
    for (const NamedParameter& p : d.parameters_before) order.push_back(&p);
    for (const NamedParameter& p : d.parameters_after) if (named(d.parameters_before, p.name) == nullptr) order.push_back(&p);
    DataList list;
    for (const NamedParameter* p : order) {
        constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
        const NamedParameter* const before = named(d.parameters_before, p->name);
        const NamedParameter* const after = named(d.parameters_after, p->name);
        Data data;
        set_text(data, "parameter", p->name);
        set_text(data, "unit", unit_text(p->unit));
        data.set("has_before", before != nullptr);
        data.set("has_after", after != nullptr);
        data.set("new", before == nullptr);
        set_quantity(data, "before_", before != nullptr ? before->value : nothing, before != nullptr ? before->sd : 0);
        set_quantity(data, "after_", after != nullptr ? after->value : nothing, after != nullptr ? after->sd : 0);
        const double change = before != nullptr && after != nullptr ? 100 * (after->value - before->value) / std::abs(before->value) : nothing;
        data.set("has_change", std::isfinite(change));
        set_text(data, "change", fmt::format("{:+.1f}", std::isfinite(change) ? change : 0.0));
        list.push_back(data);
    }
    return list;
}

DataList patch_data(const std::string& patch) {
    DataList list;
    std::size_t begin = 0;
    while (begin < patch.size()) {
        const std::size_t end = std::min(patch.find('\n', begin), patch.size());
        const std::string line = patch.substr(begin, end - begin);
        const bool name = line.compare(0, 4, "+++ ") == 0 || line.compare(0, 4, "--- ") == 0;
        Data data = entry("line", line);
        data.set("kind", std::string(name ? "name" : line[0] == '+' ? "added" : line[0] == '-' ? "removed" : line[0] == '@' ? "place" : "kept"));
        list.push_back(data);
        begin = end + 1;
    }
    return list;
}

}  // namespace

std::string report_html(const Discovery& discovery, const model::Model& model, const Recording& recording, const ReportFiles& files, const Draw& draw,
                        Diagnostics& diagnostics) {
    Figures figures(draw, diagnostics);
    Data page;
    set_style(page);
    set_text(page, "model_name", model.name);
    set_text(page, "model_summary", model.summary);
    page.set("has_model_summary", !model.summary.empty());
    set_text(page, "model_file", files.model);
    set_text(page, "recording_file", files.recordings[0]);
    page.set("several_recordings", discovery.recordings.size() > 1);
    set_text(page, "recording_count", std::to_string(discovery.recordings.size()));
    set_list(page, "recordings", recordings_data(discovery));
    set_text(page, "samples", std::to_string(recording.samples()));
    set_text(page, "period", fmt::format("{:.6g}", recording.period));
    set_text(page, "train_from", fmt::format("{:.6g}", discovery.first().train_from_s));
    set_text(page, "train_to", fmt::format("{:.6g}", discovery.first().train_to_s));
    set_text(page, "test_from", fmt::format("{:.6g}", discovery.first().test_from_s));
    set_text(page, "test_to", fmt::format("{:.6g}", discovery.first().test_to_s));

    set_text(page, "verdict", name(discovery.verdict));
    for (const Verdict v : {Verdict::named, Verdict::ambiguous, Verdict::none, Verdict::unknown}) page.set(name(v), discovery.verdict == v);
    page.set("has_after", !discovery.effects.empty());
    page.set("several_effects", discovery.effects.size() > 1);
    set_list(page, "effects", effects_data(discovery));
    set_list(page, "alternatives", alternatives_data(discovery));
    set_list(page, "experiments", texts_data("experiment", discovery.experiments));
    set_list(page, "doubts", texts_data("doubt", discovery.doubts));
    set_text(page, "doubt_count", std::to_string(discovery.doubts.size()));
    page.set("several_doubts", discovery.doubts.size() > 1);
    set_gap(page, discovery);
    set_runner_up(page, discovery);
    set_list(page, "gaps", gaps_data(discovery));
    set_list(page, "tests", tests_data(discovery, model, recording, figures));
    set_list(page, "times", residuals_data(discovery, figures, [&](const EquationResidual& r) { return time_figure(discovery, r); }));
    set_list(page, "laws", residuals_data(discovery, figures, [](const EquationResidual& r) { return law_figure(r); }));
    set_list(page, "where", where_data(discovery));
    set_list(page, "evidence", evidence_data(discovery));
    set_text(page, "evidence_left_out", std::to_string(discovery.evidence.size() > most_evidence ? discovery.evidence.size() - most_evidence : 0));
    page.set("evidence_is_cut", discovery.evidence.size() > most_evidence);
    set_list(page, "parameters", parameters_data(discovery));
    set_list(page, "patch", patch_data(files.patch));
    figures.set_complaints(page);

    const std::string amended = files.amended.empty() ? files.model : files.amended;
    const std::string out = files.directory.empty() ? "." : files.directory;
    page.set("is_amended", !files.amended.empty());
    set_text(page, "amended_file", files.amended);
    set_text(page, "model_word", shell_word(files.model));
    set_text(page, "recording_word", shell_word(files.recordings[0]));
    set_text(page, "recording_words", shell_words(files.recordings));
    set_text(page, "amended_word", shell_word(amended));
    set_text(page, "patch_word", shell_word(files.patch_file));
    set_text(page, "directory_word", shell_word(out));
    set_text(page, "estimator_word", shell_word(out + "/estimator"));
    set_text(page, "estimates_word", shell_word(out + "/estimates.csv"));
    page.set("no_window", !model.window.has_value());
    return generator::render("report/discover.html.mustache", page);
}

}  // namespace algest::lab
