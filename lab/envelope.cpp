// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace algest::lab {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Which of `count` cells of [from, to] holds x.
std::size_t cell(double x, double from, double to, std::size_t count) {
    const double place = (x - from) / (to - from) * static_cast<double>(count);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count) - 1));
}

}  // namespace

Curve envelope(const Curve& curve, double from, double to, std::size_t columns) {
    Curve out;
    if (curve.x.size() <= 2 * columns || !(to > from)) return curve;
    std::size_t k = 0;
    while (k < curve.x.size()) {
        const std::size_t column = cell(curve.x[k], from, to, columns);
        std::size_t low = k, high = k, end = k;
        bool broken = false;
        for (; end < curve.x.size() && cell(curve.x[end], from, to, columns) == column; ++end) {
            if (!std::isfinite(curve.y[end])) {
                broken = true;
                break;
            }
            if (curve.y[end] < curve.y[low]) low = end;
            if (curve.y[end] > curve.y[high]) high = end;
        }
        if (end > k) {
            out.x.push_back(curve.x[std::min(low, high)]);
            out.y.push_back(curve.y[std::min(low, high)]);
            if (low != high) {
                out.x.push_back(curve.x[std::max(low, high)]);
                out.y.push_back(curve.y[std::max(low, high)]);
            }
        }
        if (broken) {
            out.x.push_back(curve.x[end]);
            out.y.push_back(nan);
            ++end;
        }
        k = end;
    }
    return out;
}

Curve thinned(const Curve& points, double x_from, double x_to, double y_from, double y_to, std::size_t columns, std::size_t rows) {
    Curve out;
    std::vector<bool> taken(columns * rows);
    for (std::size_t k = 0; k < points.x.size(); ++k) {
        const double x = points.x[k];
        const double y = points.y[k];
        if (!(x >= x_from && x <= x_to && y >= y_from && y <= y_to)) continue;
        const std::size_t place = cell(y, y_from, y_to, rows) * columns + cell(x, x_from, x_to, columns);
        if (taken[place]) continue;
        taken[place] = true;
        out.x.push_back(x);
        out.y.push_back(y);
    }
    return out;
}

// Of the range: points of two branches alternate in x, so that a point stands as far from the mean of its neighbours as the branches are
// apart. A panel of 200 px shows 6 px then, no more than the dots that would be drawn instead of the line: nothing is lost by the line.
constexpr double least_fork = 0.03;

bool is_function(const Curve& sorted) {
    if (sorted.x.size() < 8) return false;
    const auto [low, high] = std::minmax_element(sorted.y.begin(), sorted.y.end());
    const double range = *high - *low;
    if (!(range > 0)) return true;
    std::vector<double> bends;
    for (std::size_t k = 1; k + 1 < sorted.y.size(); ++k) bends.push_back(std::abs(sorted.y[k] - 0.5 * (sorted.y[k - 1] + sorted.y[k + 1])) / range);
    const auto ninth = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() * 9 / 10);
    std::nth_element(bends.begin(), ninth, bends.end());
    return *ninth < least_fork;
}

Curve mean_line(const Curve& sorted, std::size_t columns) {
    Curve out;
    if (sorted.x.empty() || !(sorted.x.back() > sorted.x.front())) return out;
    std::size_t k = 0;
    while (k < sorted.x.size()) {
        const std::size_t column = cell(sorted.x[k], sorted.x.front(), sorted.x.back(), columns);
        double x = 0;
        double y = 0;
        std::size_t count = 0;
        for (; k < sorted.x.size() && cell(sorted.x[k], sorted.x.front(), sorted.x.back(), columns) == column; ++k, ++count) {
            x += sorted.x[k];
            y += sorted.y[k];
        }
        out.x.push_back(x / static_cast<double>(count));
        out.y.push_back(y / static_cast<double>(count));
    }
    return out;
}

Curve sorted_by_x(const Curve& points) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < points.x.size(); ++k) if (std::isfinite(points.x[k]) && std::isfinite(points.y[k])) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points.x[a] < points.x[b]; });
    Curve out;
    for (const std::size_t k : order) {
        out.x.push_back(points.x[k]);
        out.y.push_back(points.y[k]);
    }
    return out;
}

}  // namespace algest::lab
