// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/replay_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lab/figure_parts.hpp"

namespace algest::lab {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double top = 16, bottom = 176;
constexpr std::size_t status_columns = 400;    ///< of the tints
constexpr double narrowest_tint = 0.005;       ///< of the axis: one rejected sample is to be seen
constexpr double estimates_beyond = 0.02;      ///< share of the estimates that may lie beyond the axis, on each side
constexpr double intervals_beyond = 0.1;       ///< and of their intervals
constexpr double finest_axis = 1e-3;           ///< of the value: numbers with more digits run into the axis's label, and no controller asks for them

/// What of several statuses a reader must see.
int weight(Status status) {
    switch (status) {
        case Status::ok: return 0;
        case Status::filling: return 1;
        case Status::singular: return 2;
        case Status::rejected: return 3;
    }
    return 0;
}

/// By weight; ok has none.
constexpr std::array<const char*, 4> tints = {nullptr, colour::filling, colour::singular, colour::rejected};

/// Runs of columns with the same gravest status.
std::vector<Tint> status_tints(const Replay& replay) {
    const std::size_t samples = replay.samples();
    const std::size_t columns = std::min(status_columns, samples);
    std::vector<Tint> out;
    int before = 0;
    for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t begin = c * samples / columns;
        const std::size_t end = (c + 1) * samples / columns;
        int gravest = 0;
        for (std::size_t k = begin; k < end; ++k) gravest = std::max(gravest, weight(replay.status[k]));
        const double to = replay.t[std::min(end, samples - 1)];
        if (gravest != 0 && gravest == before) out.back().over.to = to;
        else if (gravest != 0) out.push_back({{replay.t[begin], to}, tints[static_cast<std::size_t>(gravest)]});
        before = gravest;
    }
    const double narrowest = narrowest_tint * (replay.t.back() - replay.t.front());
    for (Tint& tint : out) tint.over.to = std::max(tint.over.to, tint.over.from + narrowest);
    return out;
}

/// The axis and the place of a panel over the time of the replay.
Panel panel_over_time(const Replay& replay) {
    Panel panel{};
    panel.x = {"t", "s", replay.t.front(), replay.t.back(), true};
    panel.left = room_left;
    panel.right = right_edge;
    panel.top = top;
    panel.bottom = bottom;
    panel.marked = status_tints(replay);
    return panel;
}

Figure figure_of(const std::string& title, Panel panel) {
    return {title, static_cast<int>(figure_width), static_cast<int>(bottom + room_below), {std::move(panel)}};
}

/// Takes the finite values but a share `beyond` on each side.
void take_most(Extent& extent, std::vector<double> values, double beyond) {
    values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }), values.end());
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    const auto left_out = static_cast<std::size_t>(beyond * static_cast<double>(values.size()));
    extent.take(values[left_out]);
    extent.take(values[values.size() - 1 - left_out]);
}

/// What leaves the axis ends at it: gnuplot leaves gaps where it clips.
void clip(Area& area, const Interval& y) {
    for (std::vector<double>* edge : {&area.low, &area.high}) {
        for (double& v : *edge) if (std::isfinite(v)) v = std::clamp(v, y.from, y.to);
    }
}

}  // namespace

std::optional<Figure> estimate_figure(const plan::Plan& plan, const Replay& replay, std::size_t parameter) {
    if (replay.samples() < 2) return std::nullopt;
    Curve estimated{replay.t, {}}, held{replay.t, {}};
    Area interval{{}, {}, {}, "two standard deviations", colour::interval};
    std::vector<double> values;
    bool ever = false;
    for (std::size_t k = 0; k < replay.samples(); ++k) {
        const double value = replay.parameter(k, parameter);
        const bool ok = replay.status[k] == Status::ok;
        if (ok) values.push_back(value);
        estimated.y.push_back(ok ? value : nan);
        held.y.push_back(ever && !ok ? value : nan);
        ever = ever || ok;
        const double deviation = replay.deviations.empty() ? nan : replay.deviation(k, parameter);
        if (ok && !std::isfinite(deviation)) continue;   // between two samples that have one
        interval.x.push_back(replay.t[k]);
        interval.low.push_back(ok ? value - band_sds * deviation : nan);
        interval.high.push_back(ok ? value + band_sds * deviation : nan);
    }
    if (values.empty()) return std::nullopt;
    Panel panel = panel_over_time(replay);
    Extent extent;
    take_most(extent, values, estimates_beyond);
    take_most(extent, interval.low, intervals_beyond);
    take_most(extent, interval.high, intervals_beyond);
    extent.take(values.back());
    const Interval y = extent.widened(0.12, finest_axis);
    clip(interval, y);
    const plan::Parameter& named = plan.parameters[parameter];
    panel.y = {named.name, named.unit, y.from, y.to, true};
    panel.areas.push_back(std::move(interval));
    draw_line(panel, held, "held", colour::held, 1);
    draw_line(panel, estimated, "estimate", colour::after, 1.5);
    return figure_of("estimate of " + named.name, std::move(panel));
}

std::optional<Figure> condition_figure(const Replay& replay) {
    if (replay.samples() < 2) return std::nullopt;
    Curve logarithm{replay.t, {}};
    Extent extent;
    for (const double condition : replay.condition) {
        logarithm.y.push_back(std::isfinite(condition) && condition > 0 ? std::log10(condition) : nan);
        extent.take(logarithm.y.back());
    }
    if (extent.empty()) return std::nullopt;
    Panel panel = panel_over_time(replay);
    const Interval y = extent.widened(0.08, finest_axis);
    panel.y = {"log10(condition)", "1", y.from, y.to, true};
    draw_line(panel, logarithm, "condition", colour::after, 1.5);
    return figure_of("condition", std::move(panel));
}

}  // namespace algest::lab
