// SPDX-License-Identifier: GPL-3.0-or-later
// Series made small enough to be drawn: what the eye would not tell apart on so many pixels is left out.
#pragma once
#include <cstddef>
#include <vector>

namespace algest::lab {

/// Points in the order in which they are drawn; y is NaN where a line is broken.
struct Curve {
    std::vector<double> x;
    std::vector<double> y;
};

/// Per column the smallest and the largest y in the order of time, so that no peak is lost; as it is where it has no more than
/// twice as many points as columns. x does not decrease; what is not finite breaks the line.
Curve envelope(const Curve& curve, double from, double to, std::size_t columns);

/// One point for every cell of a grid of columns x rows that has any: the first. Points outside or not finite are left out.
Curve thinned(const Curve& points, double x_from, double x_to, double y_from, double y_to, std::size_t columns, std::size_t rows);

/// True where y is a function of x, but for a tenth of the points: neighbours in x lie on a curve. x does not decrease.
bool is_function(const Curve& sorted);

/// The mean of each column: a line through points that are a function of x. x does not decrease.
Curve mean_line(const Curve& sorted, std::size_t columns);

/// The points in the order of x; those that are not finite are left out.
Curve sorted_by_x(const Curve& points);

}  // namespace algest::lab
