// SPDX-License-Identifier: GPL-3.0-or-later
// Exact polynomial kernel on [0,1] -> its weights as what moments see: one polynomial of the sample's place in the window, and what the ends of
// the window count besides.
#pragma once
#include <vector>

#include "generator/kernel.hpp"
#include "generator/plan.hpp"

namespace algest::kernel {

/// Weight of sample m of 0 .. M: sum_j coefficients[j] v^j with v = (2m - M) step, plus `oldest` at m = 0 and `newest` at m = M.
struct WindowPolynomial {
    Coefficients coefficients;   ///< as many as the kernel has, lowest power first
    exact::Rational oldest;
    exact::Rational newest;
};

/// The power of two by which coordinates of the frames of moments over `intervals` are multiplied: it brings all of them into [-1,1].
exact::Rational coordinate_step(int intervals);

/// The same weights as weights(). quadrature must not be simpson, whose weights alternate. Cost: degree^2 operations on rationals.
WindowPolynomial window_polynomial(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature, const exact::Rational& step);

/// Weights of a window of n intervals, for every n at once, by powers of h = 1/n: that of sample m is h sum_i h^i p_i(v), v = (2m - n)/n, plus
/// h sum_i h^i newest_i at m = n; and something at m = 0, from which growing windows are measured.
struct GrowingPolynomial {
    std::vector<Coefficients> by_power;   ///< p_i, each with as many coefficients as the kernel
    Coefficients newest;
};
/// The same weights as weights() with the exact quadrature. Cost: degree^3 operations on rationals.
GrowingPolynomial growing_polynomial(const Coefficients& kernel, plan::Hold hold);

}  // namespace algest::kernel
