// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/report_figures.hpp"

#include <algorithm>
#include <cmath>

#include "lab/figure_parts.hpp"
#include "lab/simulate.hpp"

namespace algest::lab {

namespace {

constexpr double wide_dot = 5;               ///< px, of what lies below dots and must be seen

bool has_after(const Discovery& discovery) { return !discovery.effects.empty() && !discovery.first().after.signals.empty(); }

}  // namespace

std::optional<OutputFigure> test_figure(const Discovery& discovery, const model::Model& model, const Recording& recording, const OutputGap& output) {
    const model::Signal* const signal = model.signal(output.signal);
    if (signal == nullptr) return std::nullopt;
    const auto index = static_cast<std::size_t>(model.signal_index(output.signal));
    Diagnostics quiet;   // discover has said what there is to say
    const auto values = signal_values(recording, {signal->name, signal->column, signal->unit}, quiet);
    const RecordingEvidence& first = discovery.first();
    if (!values || index >= first.before.signals.size() || first.before.signals[index].empty()) return std::nullopt;
    const double noise = std::isfinite(output.floor) ? output.floor * size_of(*values) : 0.0;

    std::vector<double> t, measured;
    std::vector<DrawnRun> runs = {{"before", colour::before, {}}};
    if (has_after(discovery)) runs.push_back({"after", colour::after, {}});
    for (std::size_t row = 0; row < recording.samples(); ++row) {
        const double now = recording.t[row];
        if (now < first.test_from_s - 0.5 * recording.period || now > first.test_to_s + 0.5 * recording.period) continue;
        t.push_back(now);
        measured.push_back((*values)[row]);
        runs[0].values.push_back(run_value(first.before, index, row));
        if (runs.size() > 1) runs[1].values.push_back(run_value(first.after, index, row));
    }
    return output_figure(*signal, t, measured, runs, noise, "test stretch");
}

std::optional<Figure> time_figure(const Discovery& discovery, const EquationResidual& residual) {
    if (residual.t.size() < 2 || residual.before.size() != residual.t.size()) return std::nullopt;
    Panel panel{};
    panel.left = room_left;
    panel.right = right_edge;
    panel.top = 28;
    panel.bottom = 212;
    panel.x = {"t", "s", residual.t.front(), residual.t.back(), true};
    if (!(panel.x.to > panel.x.from)) return std::nullopt;
    const bool after = residual.after.size() == residual.t.size();
    Extent extent;
    extent.take(-1.5 * band_sds * residual.noise);
    extent.take(1.5 * band_sds * residual.noise);
    extent.take(residual.before);
    if (after) take_some(extent, residual.after, 0.5 * extent.span());
    const Interval y = extent.widened(0.06);
    panel.y = {"residual", residual.unit, y.from, y.to, true};
    band_of_noise(panel, residual.noise);
    const auto mark = [&](double from, double to, const char* text) {
        const double shown_from = std::max(from, panel.x.from);
        const double shown_to = std::min(to, panel.x.to);
        if (!(shown_to - shown_from > 0.08 * (panel.x.to - panel.x.from))) return;   // no room for its name
        panel.headings.push_back({0.5 * (shown_from + shown_to), text});
    };
    mark(discovery.first().train_from_s, discovery.first().train_to_s, "train");
    mark(discovery.first().test_from_s, discovery.first().test_to_s, "test");
    panel.marked = {{{discovery.first().test_from_s, discovery.first().test_to_s}}};
    draw_line(panel, {residual.t, residual.before}, "before", colour::before, 1.2);
    if (after) draw_line(panel, {residual.t, residual.after}, "after", colour::after, 1.2);
    return Figure{"residual of " + residual.equation + " over time", static_cast<int>(figure_width), static_cast<int>(panel.bottom + room_below), {panel}};
}

std::optional<Figure> law_figure(const EquationResidual& residual) {
    if (residual.x.size() < 2 || residual.x.size() != residual.before.size()) return std::nullopt;
    const bool after = residual.after.size() == residual.x.size();
    const bool law = residual.law.size() == residual.x.size();
    Panel panel{};
    panel.top = 28;
    panel.bottom = 248;
    panel.left = room_left;
    panel.right = after ? 0.5 * figure_width - 10 : right_edge;
    // Beside its law belongs what the amended model leaves without it: the model as it was, refitted, hides part of it in other parameters.
    std::vector<double> open = residual.before;
    if (law && after) for (std::size_t k = 0; k < open.size(); ++k) open[k] = residual.after[k] + residual.law[k];
    Extent x;
    x.take(residual.x);
    Extent y;
    y.take(open);
    if (law) y.take(residual.law);
    if (after) y.take(residual.after);
    if (x.empty() || y.empty()) return std::nullopt;
    const Interval across = x.widened(0.02);
    const Interval up = y.widened(0.06);
    panel.x = {residual.signal, residual.signal_unit, across.from, across.to, true};
    panel.y = {"residual", residual.unit, up.from, up.to, true};
    band_of_noise(panel, residual.noise);
    const double centre = 0.5 * (across.from + across.to);
    Figure out{"residual of " + residual.equation + " against " + residual.signal, static_cast<int>(figure_width), static_cast<int>(panel.bottom + room_below), {}};
    Panel left = panel;
    const Curve sorted = law ? sorted_by_x({residual.x, residual.law}) : Curve{};
    const bool line = is_function(sorted);
    if (law && !line) draw_dots(left, sorted, "law", colour::law, wide_dot);
    draw_dots(left, {residual.x, open}, law && after ? "without the added terms" : "before", law && after ? colour::without : colour::before);
    if (line) left.drawn.push_back({mean_line(sorted, 240), "law", colour::law, 2, false});
    left.headings = {{centre, law && after ? "without the added terms, and their law" : "before"}};
    out.panels.push_back(left);
    if (after) {
        Panel right = panel;
        right.left = 0.5 * figure_width + room_left;
        right.right = right_edge;
        draw_dots(right, {residual.x, residual.after}, "after", colour::after);
        right.headings = {{centre, "after"}};
        out.panels.push_back(right);
    }
    return out;
}

}  // namespace algest::lab
