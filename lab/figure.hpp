// SPDX-License-Identifier: GPL-3.0-or-later
// A figure as data, in pixels and in the units of its axes, and its gnuplot script.
#pragma once
#include <string>
#include <vector>

#include "lab/envelope.hpp"

namespace algest::lab {

struct Axis {
    std::string name;
    std::string unit;     ///< empty: not known, and shown so
    double from;          ///< from < to, both finite
    double to;
    bool shown = true;    ///< false: the panel below carries the numbers
};

struct Drawn {
    Curve curve;
    std::string title;    ///< shown by a browser under the pointer
    std::string colour;   ///< #rrggbb
    double width;         ///< px; of a point its diameter
    bool points = false;  ///< a dot for each, no line
};

struct Interval {
    double from;
    double to;
};

/// An interval of x that is tinted.
struct Tint {
    Interval over;
    std::string colour = "#56b4e9";   ///< #rrggbb, shown through
};

/// What lies between two lines, filled; a break in either breaks it.
struct Area {
    std::vector<double> x;
    std::vector<double> low;
    std::vector<double> high;
    std::string title;
    std::string colour;   ///< #rrggbb
};

struct Panel {
    double left, right, top, bottom;       ///< px from the figure's left and top edges: the axes, without their labels
    Axis x;
    Axis y;
    std::vector<Interval> bands;           ///< of y, grey with dashed edges: what noise makes
    std::vector<Tint> marked;
    std::vector<std::pair<double, std::string>> headings;   ///< x and the text above the axes that is centred there
    std::vector<Area> areas;               ///< under all lines
    std::vector<Drawn> drawn;              ///< later ones lie on top
};

struct Figure {
    std::string title;    ///< of the drawing, for those who do not see it
    int width;            ///< px
    int height;
    std::vector<Panel> panels;
};

/// Room that labels need around the axes, px.
constexpr double room_left = 86;
constexpr double room_below = 50;

/// Commands and data for `gnuplot -d`, which then prints the figure as SVG. Names are data in it: neither enhanced, nor expanded.
/// Values beyond 10^4 or below 10^-2 are shown with their power of ten in the unit; a name too long for its axis is shortened in its middle.
std::string gnuplot_script(const Figure& figure);

}  // namespace algest::lab
