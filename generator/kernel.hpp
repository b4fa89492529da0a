// SPDX-License-Identifier: GPL-3.0-or-later
// Exact polynomial kernel on [0,1] -> weights of M+1 samples for a hold and a quadrature, each rounded once.
#pragma once
#include <vector>

#include "generator/exact.hpp"
#include "generator/plan.hpp"

namespace algest::kernel {

/// Coefficients, lowest power first.
using Coefficients = std::vector<exact::Rational>;

/// Reads what a plan's table holds.
Coefficients coefficients(const std::vector<std::string>& texts);

/// Integrals of the kernel against M+1 samples at sigma = 0, 1/M, ..., 1, oldest first, each the nearest number of the scalar.
///
/// zoh: sample m counts on [m/M, (m+1)/M), so the newest has weight 0. linear: the interpolant through the samples is
/// integrated exactly; with quadrature trapezoid or simpson, kernel times samples by that rule instead (zoh stays exact).
/// simpson needs an even M. Cost: about M times the degree in additions of long integers.
std::vector<double> weights(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature, plan::Scalar scalar);

/// The integral of the kernel over [0,1] by the same rule: what the functional of the constant 1 is.
exact::Rational integral(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature);

/// The polynomial at x, exact.
exact::Rational value_at(const Coefficients& p, const exact::Rational& x);

/// The integral over [0,1] of kernel(sigma) sigma^power, exact.
exact::Rational moment(const Coefficients& kernel, int power);

/// The antiderivative that vanishes at 0.
Coefficients antiderivative(const Coefficients& p);

/// The integral of its square over [0,1].
exact::Rational square_norm(const Coefficients& kernel);

}  // namespace algest::kernel
