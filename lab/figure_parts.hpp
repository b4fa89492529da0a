// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures of all reports are made of: their size and colours, the extent of an axis, lines and dots thinned to what the eye can tell apart.
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "lab/figure.hpp"

namespace algest::lab {

/// Colours that stay apart for the colour-blind and in print (Okabe and Ito).
namespace colour {
constexpr char measured[] = "#9a9a9a";
constexpr char before[] = "#d55e00";
constexpr char after[] = "#0072b2";
constexpr char without[] = "#cc79a7";    ///< the amended model with the added terms left out
constexpr char law[] = "#111111";
}  // namespace colour

constexpr double band_sds = 2;               ///< half the noise band, in standard deviations
constexpr double figure_width = 960;         ///< px, of every figure
constexpr double right_edge = figure_width - 22;

/// Smallest and largest of what is finite.
struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void take(double value);
    void take(const std::vector<double>& values);
    bool empty() const { return !(low <= high); }
    double span() const { return empty() ? 0 : high - low; }
    /// With some air, a share of the span; at least `least` of the largest value from end to end, so that the numbers beside an axis stay short.
    /// Where all values are the same: of any size.
    Interval widened(double share, double least = 0) const;
};

/// Takes `values`, but lets them widen the extent by no more than `most` on each side: a run that leaves must not flatten the rest.
void take_some(Extent& extent, const std::vector<double>& values, double most);

/// Columns of an envelope.
std::size_t columns(const Panel& panel);

/// x does not decrease. The panel has its place and its x already.
void draw_line(Panel& panel, const Curve& curve, const char* title, const char* colour, double line_width);

constexpr double dot = 3.2;                  ///< px
/// The panel has its place and its axes already.
void draw_dots(Panel& panel, const Curve& points, const char* title, const char* colour, double size = dot);

/// +-2 standard deviations; none where the noise is not known.
void band_of_noise(Panel& panel, double noise);

/// Gives the panel its place and thins what is drawn in it to its pixels.
void place(Panel& panel, double left, double right, double top, double bottom);

}  // namespace algest::lab
