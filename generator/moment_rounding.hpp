// SPDX-License-Identifier: GPL-3.0-or-later
// What rounding costs a functional that is evaluated from windowed moments.
#pragma once
#include "generator/window_polynomial.hpp"

namespace algest::generator {

/// Of a functional's value: its rounding is at most eight in line (those of the scalar, on what is added last) of |value| + |c F[1]| + gain times
/// the sum of |x - c| over the frame that is served, c the sample that the frame measures from (runtime's moments.hpp).
///
/// Counted are one rounding of each x - c, and those of the accumulators: of n additions a frame, n/2 where it sums a constant, whose roundings are
/// all alike (with the window's shift inside the frame at its largest), and 8 + sqrt(n) of the rest, which are as good as random, both at the largest
/// coordinate. Pessimistic, ten to fifty times.
exact::Rational rounding_gain(const kernel::WindowPolynomial& polynomial, int intervals, const exact::Rational& step, plan::Scalar scalar, plan::Accumulators accumulators);

}  // namespace algest::generator
