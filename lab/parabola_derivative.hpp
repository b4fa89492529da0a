// SPDX-License-Identifier: GPL-3.0-or-later
// The derivative of a recorded signal by the parabola filter as 001 prints it (appendix A): any increasing instants, first and last sample too.
#pragma once
#include <vector>

namespace algest::lab {

struct FilteredSignal {
    std::vector<double> value;
    std::vector<double> derivative;   ///< per unit of t
};

/// Equations (5) to (8). At the first sample the value is z_0 and the derivative the difference quotient to the next one; at the last the value is
/// z_N and the derivative the difference quotient from the filtered value before it. t increases; two samples or more, as many of z.
/// Where steps are equal the interior is the runtime's ParabolaFilter, up to rounding. Cost: 20 operations a sample.
FilteredSignal parabola_derivative(const std::vector<double>& t, const std::vector<double>& z);

}  // namespace algest::lab
