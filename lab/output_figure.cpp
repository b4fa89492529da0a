// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/output_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/figure_parts.hpp"

namespace algest::lab {

namespace {

constexpr std::size_t dense_rows = 600;      ///< a stretch with more samples may need a detail
constexpr std::size_t dense_swings = 24;     ///< and so may one with more swings
constexpr std::size_t swings_shown = 8;      ///< in a detail
constexpr std::size_t least_rows_shown = 60;

/// What is drawn of one output, and the errors that follow.
struct Series {
    const model::Signal& signal;
    const std::vector<double>& t;
    const std::vector<double>& measured;
    const std::vector<DrawnRun>& runs;
    std::vector<std::vector<double>> errors;   ///< by run

    Curve part(const std::vector<double>& y, std::size_t first, std::size_t last) const {
        const auto cut = [&](const std::vector<double>& v) { return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(first), v.begin() + static_cast<std::ptrdiff_t>(last)); };
        return {cut(t), cut(y)};
    }
};

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

/// Rows [first, last) of the detail: some swings, where the error of the first run is largest. The whole where all can be read.
std::pair<std::size_t, std::size_t> detail_rows(const Series& series) {
    const std::size_t rows = series.t.size();
    if (series.measured.empty() || series.runs.empty()) return {0, rows};
    const std::size_t count = swings(series.measured);
    if (rows < 2 * least_rows_shown || (rows < dense_rows && count < dense_swings)) return {0, rows};
    const std::size_t by_swings = count > 0 ? rows * swings_shown / count : rows;
    const std::size_t shown = std::clamp(by_swings, least_rows_shown, std::max(rows / 8, least_rows_shown));
    const std::vector<double>& error = series.errors.front();
    double sum = 0;
    double most = -1;
    std::size_t best = 0;
    const auto square = [&](std::size_t k) { return std::isfinite(error[k]) ? error[k] * error[k] : 0.0; };
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

Panel value_panel(const Series& series, std::size_t first, std::size_t last) {
    Panel panel{};
    panel.x = {"t", "s", series.t[first], series.t[last - 1], series.measured.empty()};
    Extent extent;
    if (!series.measured.empty()) {
        const Curve measured = series.part(series.measured, first, last);
        extent.take(measured.y);
        panel.drawn = {{measured, "measured", colour::measured, 4, false}};
    }
    const double span = std::max(extent.span(), 1e-12 * std::abs(extent.high));
    for (auto run = series.runs.rbegin(); run != series.runs.rend(); ++run) take_some(extent, series.part(run->values, first, last).y, 0.5 * span);
    for (const DrawnRun& run : series.runs) panel.drawn.push_back({series.part(run.values, first, last), run.title, run.colour, 1.5, false});
    const Interval y = extent.widened(0.06);
    panel.y = {series.signal.name, series.signal.unit, y.from, y.to, true};
    return panel;
}

Panel error_panel(const Series& series, double noise, std::size_t first, std::size_t last) {
    Panel panel{};
    panel.x = {"t", "s", series.t[first], series.t[last - 1], true};
    Extent measured;
    measured.take(series.measured);
    Extent extent;
    extent.take(-1.5 * band_sds * noise);
    extent.take(1.5 * band_sds * noise);
    for (std::size_t r = series.runs.size(); r-- > 0;) {
        const double spans = r > 0 ? 2 : 1;
        take_some(extent, series.part(series.errors[r], first, last).y, spans * measured.span());
    }
    const Interval y = extent.widened(0.06);
    panel.y = {"error", series.signal.unit, y.from, y.to, true};
    band_of_noise(panel, noise);
    for (std::size_t r = 0; r < series.runs.size(); ++r) panel.drawn.push_back({series.part(series.errors[r], first, last), "error " + series.runs[r].title, series.runs[r].colour, 1.2, false});
    return panel;
}

/// True where a run ends in the stretch or leaves the axes for good.
bool diverges(const std::vector<double>& run, const Axis& y) {
    return !std::isfinite(run.back()) || run.back() < y.from || run.back() > y.to;
}

constexpr double top = 28, middle = 200, lower_top = 222, lower_bottom = 362;

void add_panels(Figure& figure, Panel values, std::optional<Panel> errors, double left, double right) {
    place(values, left, right, top, middle);
    figure.panels.push_back(std::move(values));
    if (!errors) return;
    place(*errors, left, right, lower_top, lower_bottom);
    figure.panels.push_back(std::move(*errors));
}

}  // namespace

double run_value(const FreeRun& run, std::size_t signal, std::size_t row) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (signal >= run.signals.size() || row >= run.signals[signal].size()) return nan;
    return run.signals[signal][row];
}

std::optional<OutputFigure> output_figure(const model::Signal& signal, const std::vector<double>& t, const std::vector<double>& measured,
                                          const std::vector<DrawnRun>& runs, double noise, const std::string& heading) {
    if (t.size() < 2) return std::nullopt;
    const bool compared = !measured.empty();
    Series series{signal, t, measured, runs, {}};
    for (const DrawnRun& run : runs) {
        std::vector<double> error(compared ? t.size() : 0);
        for (std::size_t k = 0; k < error.size(); ++k) error[k] = measured[k] - run.values[k];
        series.errors.push_back(std::move(error));
    }
    const auto errors = [&](std::size_t first, std::size_t last) { return compared ? std::optional(error_panel(series, noise, first, last)) : std::nullopt; };
    const auto [first, last] = detail_rows(series);
    const bool detail = last - first < t.size();
    const double split = detail ? 0.56 * figure_width : right_edge;
    Panel values_all = value_panel(series, 0, t.size());
    std::optional<Panel> errors_all = errors(0, t.size());
    values_all.headings = {{0.5 * (t.front() + t.back()), heading}};
    OutputFigure out{{(compared ? "measured and simulated " : "simulated ") + signal.name, static_cast<int>(figure_width), static_cast<int>((compared ? lower_bottom : middle) + room_below), {}},
                     noise, detail, {}};
    for (const DrawnRun& run : runs) out.diverges.push_back(diverges(run.values, values_all.y));
    const Interval shown{t[first], t[last - 1]};
    if (detail) {
        values_all.marked = {{shown}};
        errors_all->marked = {{shown}};
    }
    add_panels(out.figure, std::move(values_all), std::move(errors_all), room_left, split);
    if (detail) {
        Panel values_part = value_panel(series, first, last);
        values_part.headings = {{0.5 * (shown.from + shown.to), "detail: the tinted part, where " + runs.front().title + " is off most"}};
        add_panels(out.figure, std::move(values_part), errors(first, last), split + room_left + 14, right_edge);
    }
    return out;
}

}  // namespace algest::lab
