// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/replay_report.hpp"

#include <fmt/format.h>

#include <limits>

#include "lab/discrete_system.hpp"
#include "lab/estimates_run.hpp"
#include "lab/figure_parts.hpp"
#include "lab/mathml.hpp"
#include "lab/quantity.hpp"
#include "lab/replay_figures.hpp"

namespace algest::lab {

namespace {

DataList parameters_data(const Replayed& r) {
    DataList list;
    for (std::size_t p = 0; p < r.plan.parameters.size(); ++p) {
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        Data data;
        set_text(data, "parameter", r.plan.parameters[p].name);
        set_text(data, "unit", unit_text(r.plan.parameters[p].unit));
        set_quantity(data, "last_", r.summary.last[p].value_or(nothing), r.summary.deviation[p].value_or(0));
        set_quantity(data, "median_", r.summary.median[p].value_or(nothing), 0);
        list.push_back(data);
    }
    return list;
}

/// Continuous-time poles of the last ok sample; none where the plan is not discrete-time.
DataList poles_data(const Replayed& r) {
    DataList list;
    if (!r.plan.discrete || !r.summary.condition_last) return list;
    std::vector<double> last;
    for (const std::optional<double> value : r.summary.last) last.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    const auto system = discrete_system(r.plan, last);
    if (!system) return list;
    for (const std::complex<double> pole : system->poles_s) {
        const double size = std::abs(pole);
        Data data;
        set_quantity(data, "real_", pole.real(), 0);
        set_quantity(data, "imaginary_", pole.imag(), 0);
        set_quantity(data, "size_", size, 0);
        set_quantity(data, "damping_", size > 0 ? -pole.real() / size : std::numeric_limits<double>::quiet_NaN(), 0);
        list.push_back(data);
    }
    return list;
}

DataList estimates_data(const Replayed& r, Figures& figures) {
    DataList list;
    for (std::size_t p = 0; p < r.plan.parameters.size(); ++p) {
        const auto figure = estimate_figure(r.plan, r.replay, p);
        if (!figure) continue;
        Data data;
        set_text(data, "parameter", r.plan.parameters[p].name);
        set_text(data, "unit", unit_text(r.plan.parameters[p].unit));
        figures.set(data, *figure);
        list.push_back(data);
    }
    return list;
}

DataList statuses_data(const Replayed& r) {
    DataList list;
    for (std::size_t s = 0; s < r.summary.count.size(); ++s) {
        Data data;
        set_text(data, "status", name(static_cast<Status>(s)));
        set_text(data, "count", std::to_string(r.summary.count[s]));
        set_text(data, "share", fmt::format("{:.1f}", 100.0 * static_cast<double>(r.summary.count[s]) / static_cast<double>(r.replay.samples())));
        for (const Status one : {Status::filling, Status::ok, Status::singular, Status::rejected}) data.set(name(one), one == static_cast<Status>(s));
        list.push_back(data);
    }
    return list;
}

/// Sets `outputs_section`, or `not_simulated`: why there is no free run.
void set_free_run(Data& page, const Replayed& r, Figures& figures) {
    Diagnostics complaints;
    const auto estimated = estimates_run(r.model, r.plan, r.recording, r.replay, r.summary, complaints);
    page.set("simulated", estimated.has_value());
    page.set("outputs_section", std::string());
    if (estimated) {
        const Bench& bench = estimated->bench;
        const FreeRun run = free_run(bench.system, estimated->parameters, bench.initial, bench.drive, bench.options);
        page.set("outputs_section", outputs_html(r.model, estimated->stretch, bench, run, figures));
    }
    std::string why;
    for (const Diagnostic& d : complaints.sorted()) if (why.empty() && d.severity == Severity::error) why = d.what;
    set_text(page, "not_simulated", why);
}

}  // namespace

std::string replay_report(const Replayed& r, const PageFrame& frame, const Draw& draw, Diagnostics& diagnostics) {
    Figures figures(draw, diagnostics);
    Data page;
    set_frame(page, frame, r.plan.name, r.plan.summary, r.plan.source);
    page.set("colour_filling", std::string(colour::filling));
    page.set("colour_singular", std::string(colour::singular));
    page.set("colour_rejected", std::string(colour::rejected));
    page.set("colour_interval", std::string(colour::interval));
    page.set("colour_held", std::string(colour::held));
    set_text(page, "samples", std::to_string(r.replay.samples()));
    set_text(page, "period", fmt::format("{:.6g}", r.recording.period));
    set_text(page, "from_s", fmt::format("{:.6g}", r.replay.t.front()));
    set_text(page, "to_s", fmt::format("{:.6g}", r.replay.t.back()));
    page.set("single_precision", r.plan.scalar == plan::Scalar::float32);
    page.set("uncertain", r.plan.uncertain());
    set_list(page, "parameters", parameters_data(r));
    DataList doubts;
    for (const std::string& text : r.doubts) doubts.push_back(entry("doubt", text));
    set_list(page, "doubts", std::move(doubts));
    set_list(page, "poles", poles_data(r));
    set_list(page, "estimates", estimates_data(r, figures));
    set_list(page, "statuses", statuses_data(r));
    page.set("has_condition", r.summary.condition_last.has_value());
    set_text(page, "condition_median", r.summary.condition_median ? three_digits(*r.summary.condition_median) : "-");
    set_text(page, "condition_last", r.summary.condition_last ? three_digits(*r.summary.condition_last) : "-");
    const auto condition = condition_figure(r.replay);
    page.set("condition_drawn", condition.has_value());
    if (condition) figures.set(page, *condition);
    set_free_run(page, r, figures);
    DataList notes;
    for (const std::string& text : r.plan.notes) notes.push_back(entry("note", text));
    set_list(page, "notes", std::move(notes));
    page.set("derivation", html_of_latex(r.derivation));
    figures.set_complaints(page);
    return generator::render("report/replay.html.mustache", page);
}

}  // namespace algest::lab
