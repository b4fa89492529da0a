// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/report_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/simulate.hpp"

namespace algest::lab {

namespace {

constexpr double band_sds = 2;               ///< half the noise band, in standard deviations
constexpr double width = 960;                ///< px, of every figure
constexpr double right_edge = width - 22;
constexpr double pixels_per_column = 1.5;    ///< of an envelope
constexpr double dot = 3.2;                  ///< px
constexpr double wide_dot = 5;               ///< px, of what lies below dots and must be seen
constexpr std::size_t dense_rows = 600;      ///< a stretch with more samples may need a detail
constexpr std::size_t dense_swings = 24;     ///< and so may one with more swings
constexpr std::size_t swings_shown = 8;      ///< in a detail
constexpr std::size_t least_rows_shown = 60;

/// Smallest and largest of what is finite.
struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void take(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void take(const std::vector<double>& values) { for (const double v : values) take(v); }
    bool empty() const { return !(low <= high); }
    double span() const { return empty() ? 0 : high - low; }

    /// With some air; of any size where all values are the same.
    Stretch widened(double share) const {
        if (empty()) return {-1, 1};
        const double size = std::max(std::abs(low), std::abs(high));
        const double room = span() > 1e-9 * size ? share * span() : size > 0 ? 0.1 * size : 1;
        return {low - room, high + room};
    }
};

/// Takes `values`, but lets them widen the extent by no more than `most` on each side: a run that leaves must not flatten the rest.
void take_some(Extent& extent, const std::vector<double>& values, double most) {
    Extent all;
    all.take(values);
    if (all.empty()) return;
    if (extent.empty()) {
        extent = all;
        return;
    }
    const Extent known = extent;
    extent.take(std::max(all.low, known.low - most));
    extent.take(std::min(all.high, known.high + most));
}

std::size_t columns(const Panel& panel) { return static_cast<std::size_t>((panel.right - panel.left) / pixels_per_column); }

void draw_line(Panel& panel, const Curve& curve, const char* title, const char* colour, double line_width) {
    panel.drawn.push_back({envelope(curve, panel.x.from, panel.x.to, columns(panel)), title, colour, line_width, false});
}

void draw_dots(Panel& panel, const Curve& points, const char* title, const char* colour, double size = dot) {
    const auto across = static_cast<std::size_t>((panel.right - panel.left) / dot);
    const auto up = static_cast<std::size_t>((panel.bottom - panel.top) / dot);
    panel.drawn.push_back({thinned(points, panel.x.from, panel.x.to, panel.y.from, panel.y.to, across, up), title, colour, size, true});
}

void band_of_noise(Panel& panel, double noise) {
    if (noise > 0 && std::isfinite(noise)) panel.bands.push_back({-band_sds * noise, band_sds * noise});
}

/// The four series of an output over the test stretch.
struct Series {
    std::vector<double> t, measured, before, after, error_before, error_after;

    Curve part(const std::vector<double>& y, std::size_t first, std::size_t last) const {
        const auto cut = [&](const std::vector<double>& v) { return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(first), v.begin() + static_cast<std::ptrdiff_t>(last)); };
        return {cut(t), cut(y)};
    }
};

/// NaN where a run has no sample: it ended.
double at(const FreeRun& run, std::size_t signal, std::size_t row) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (signal >= run.signals.size() || row >= run.signals[signal].size()) return nan;
    return run.signals[signal][row];
}

/// How often the signal passes from below to above its mean or back, by more than a tenth of its size.
std::size_t swings(const std::vector<double>& values) {
    double mean = 0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    double power = 0;
    for (const double v : values) power += (v - mean) * (v - mean) / static_cast<double>(values.size());
    const double threshold = 0.2 * std::sqrt(power);
    std::size_t count = 0;
    int side = 0;
    for (const double v : values) {
        const int now = v > mean + threshold ? 1 : v < mean - threshold ? -1 : side;
        if (side != 0 && now != side) ++count;
        side = now;
    }
    return count;
}

/// Rows [first, last) of the detail: some swings, where the error of the model as it was is largest. The whole where all can be read.
std::pair<std::size_t, std::size_t> detail_rows(const Series& series) {
    const std::size_t rows = series.t.size();
    const std::size_t count = swings(series.measured);
    if (rows < 2 * least_rows_shown || (rows < dense_rows && count < dense_swings)) return {0, rows};
    const std::size_t by_swings = count > 0 ? rows * swings_shown / count : rows;
    const std::size_t shown = std::clamp(by_swings, least_rows_shown, std::max(rows / 8, least_rows_shown));
    double sum = 0;
    double most = -1;
    std::size_t best = 0;
    const auto square = [&](std::size_t k) { return std::isfinite(series.error_before[k]) ? series.error_before[k] * series.error_before[k] : 0.0; };
    for (std::size_t k = 0; k < rows; ++k) {
        sum += square(k);
        if (k >= shown) sum -= square(k - shown);
        if (k + 1 >= shown && sum > most * (1 + 1e-9)) {
            most = sum;
            best = k + 1 - shown;
        }
    }
    return {best, best + shown};
}

Panel value_panel(const Series& series, const model::Signal& signal, bool after, std::size_t first, std::size_t last) {
    Panel panel{};
    panel.x = {"t", "s", series.t[first], series.t[last - 1], false};
    const Curve measured = series.part(series.measured, first, last);
    const Curve run_before = series.part(series.before, first, last);
    const Curve run_after = series.part(series.after, first, last);
    Extent extent;
    extent.take(measured.y);
    const double span = std::max(extent.span(), 1e-12 * std::abs(extent.high));
    if (after) take_some(extent, run_after.y, 0.5 * span);
    take_some(extent, run_before.y, 0.5 * span);
    const Stretch y = extent.widened(0.06);
    panel.y = {signal.name, signal.unit, y.from, y.to, true};
    panel.drawn = {{measured, "measured", colour::measured, 4, false}, {run_before, "before", colour::before, 1.5, false}};
    if (after) panel.drawn.push_back({run_after, "after", colour::after, 1.5, false});
    return panel;
}

Panel error_panel(const Series& series, const model::Signal& signal, bool after, double noise, std::size_t first, std::size_t last) {
    Panel panel{};
    panel.x = {"t", "s", series.t[first], series.t[last - 1], true};
    const Curve run_before = series.part(series.error_before, first, last);
    const Curve run_after = series.part(series.error_after, first, last);
    Extent measured;
    measured.take(series.measured);
    Extent extent;
    extent.take(-1.5 * band_sds * noise);
    extent.take(1.5 * band_sds * noise);
    if (after) take_some(extent, run_after.y, 2 * measured.span());
    take_some(extent, run_before.y, measured.span());
    const Stretch y = extent.widened(0.06);
    panel.y = {"error", signal.unit, y.from, y.to, true};
    band_of_noise(panel, noise);
    panel.drawn = {{run_before, "error before", colour::before, 1.2, false}};
    if (after) panel.drawn.push_back({run_after, "error after", colour::after, 1.2, false});
    return panel;
}

void place(Panel& panel, double left, double right, double top, double bottom) {
    panel.left = left;
    panel.right = right;
    panel.top = top;
    panel.bottom = bottom;
    for (Drawn& drawn : panel.drawn) drawn.curve = envelope(drawn.curve, panel.x.from, panel.x.to, columns(panel));
}

/// True where a run ends in the stretch or leaves the axes for good.
bool diverges(const std::vector<double>& run, const Axis& y) {
    return !std::isfinite(run.back()) || run.back() < y.from || run.back() > y.to;
}

bool has_after(const Discovery& discovery) { return !discovery.effects.empty() && !discovery.first().after.signals.empty(); }

}  // namespace

std::optional<TestFigure> test_figure(const Discovery& discovery, const model::Model& model, const Recording& recording, const OutputGap& output) {
    const model::Signal* const signal = model.signal(output.signal);
    if (signal == nullptr) return std::nullopt;
    const auto index = static_cast<std::size_t>(model.signal_index(output.signal));
    Diagnostics quiet;   // discover has said what there is to say
    const auto values = signal_values(recording, {signal->name, signal->column, signal->unit}, quiet);
    if (!values || index >= discovery.first().before.signals.size() || discovery.first().before.signals[index].empty()) return std::nullopt;
    const bool after = has_after(discovery);
    const double noise = std::isfinite(output.floor) ? output.floor * size_of(*values) : 0.0;

    Series series;
    for (std::size_t row = 0; row < recording.samples(); ++row) {
        const double t = recording.t[row];
        if (t < discovery.first().test_from_s - 0.5 * recording.period || t > discovery.first().test_to_s + 0.5 * recording.period) continue;
        series.t.push_back(t);
        series.measured.push_back((*values)[row]);
        series.before.push_back(at(discovery.first().before, index, row));
        series.after.push_back(at(discovery.first().after, index, row));
        series.error_before.push_back(series.measured.back() - series.before.back());
        series.error_after.push_back(series.measured.back() - series.after.back());
    }
    if (series.t.size() < 2) return std::nullopt;

    const auto [first, last] = detail_rows(series);
    const bool detail = last - first < series.t.size();
    constexpr double top = 28, middle = 200, lower_top = 222, lower_bottom = 362;
    const double split = detail ? 0.56 * width : right_edge;
    Panel values_all = value_panel(series, *signal, after, 0, series.t.size());
    Panel errors_all = error_panel(series, *signal, after, noise, 0, series.t.size());
    values_all.headings = {{0.5 * (series.t.front() + series.t.back()), "test stretch"}};
    TestFigure out{{"measured and simulated " + signal->name + ", test stretch", static_cast<int>(width), static_cast<int>(lower_bottom + room_below), {}},
                   noise, detail, diverges(series.before, values_all.y), after && diverges(series.after, values_all.y)};
    if (detail) {
        const Stretch shown{series.t[first], series.t[last - 1]};
        values_all.marked = {shown};
        errors_all.marked = {shown};
        Panel values_part = value_panel(series, *signal, after, first, last);
        Panel errors_part = error_panel(series, *signal, after, noise, first, last);
        values_part.headings = {{0.5 * (shown.from + shown.to), "detail: the tinted part, where before is off most"}};
        place(values_part, split + room_left + 14, right_edge, top, middle);
        place(errors_part, split + room_left + 14, right_edge, lower_top, lower_bottom);
        out.figure.panels = {values_part, errors_part};
    }
    place(values_all, room_left, split, top, middle);
    place(errors_all, room_left, split, lower_top, lower_bottom);
    out.figure.panels.insert(out.figure.panels.begin(), {values_all, errors_all});
    return out;
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
    const Stretch y = extent.widened(0.06);
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
    panel.marked = {{discovery.first().test_from_s, discovery.first().test_to_s}};
    draw_line(panel, {residual.t, residual.before}, "before", colour::before, 1.2);
    if (after) draw_line(panel, {residual.t, residual.after}, "after", colour::after, 1.2);
    return Figure{"residual of " + residual.equation + " over time", static_cast<int>(width), static_cast<int>(panel.bottom + room_below), {panel}};
}

std::optional<Figure> law_figure(const EquationResidual& residual) {
    if (residual.x.size() < 2 || residual.x.size() != residual.before.size()) return std::nullopt;
    const bool after = residual.after.size() == residual.x.size();
    const bool law = residual.law.size() == residual.x.size();
    Panel panel{};
    panel.top = 28;
    panel.bottom = 248;
    panel.left = room_left;
    panel.right = after ? 0.5 * width - 10 : right_edge;
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
    const Stretch across = x.widened(0.02);
    const Stretch up = y.widened(0.06);
    panel.x = {residual.signal, residual.signal_unit, across.from, across.to, true};
    panel.y = {"residual", residual.unit, up.from, up.to, true};
    band_of_noise(panel, residual.noise);
    const double centre = 0.5 * (across.from + across.to);
    Figure out{"residual of " + residual.equation + " against " + residual.signal, static_cast<int>(width), static_cast<int>(panel.bottom + room_below), {}};
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
        right.left = 0.5 * width + room_left;
        right.right = right_edge;
        draw_dots(right, {residual.x, residual.after}, "after", colour::after);
        right.headings = {{centre, "after"}};
        out.panels.push_back(right);
    }
    return out;
}

}  // namespace algest::lab
