// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/figure_parts.hpp"

#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

constexpr double pixels_per_column = 1.5;    ///< of an envelope

}  // namespace

void Extent::take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
}

void Extent::take(const std::vector<double>& values) {
    for (const double v : values) take(v);
}

Interval Extent::widened(double share, double least) const {
    if (empty()) return {-1, 1};
    const double size = std::max(std::abs(low), std::abs(high));
    const double air = span() > 1e-9 * size ? share * span() : size > 0 ? 0.1 * size : 1;
    const double room = std::max(air, (least * size - span()) / 2);
    return {low - room, high + room};
}

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

void draw_dots(Panel& panel, const Curve& points, const char* title, const char* colour, double size) {
    const auto across = static_cast<std::size_t>((panel.right - panel.left) / dot);
    const auto up = static_cast<std::size_t>((panel.bottom - panel.top) / dot);
    panel.drawn.push_back({thinned(points, panel.x.from, panel.x.to, panel.y.from, panel.y.to, across, up), title, colour, size, true});
}

void band_of_noise(Panel& panel, double noise) {
    if (noise > 0 && std::isfinite(noise)) panel.bands.push_back({-band_sds * noise, band_sds * noise});
}

void place(Panel& panel, double left, double right, double top, double bottom) {
    panel.left = left;
    panel.right = right;
    panel.top = top;
    panel.bottom = bottom;
    for (Drawn& drawn : panel.drawn) drawn.curve = envelope(drawn.curve, panel.x.from, panel.x.to, columns(panel));
}

}  // namespace algest::lab
