// SPDX-License-Identifier: GPL-3.0-or-later
// The integrator of all plants: Boost.Odeint, Runge-Kutta-Fehlberg 7(8) with controlled steps.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace algest::plants {

/// derivative(x, dxdt, t)
using Derivative = std::function<void(const std::vector<double>&, std::vector<double>&, double)>;

/// Moves the state from one instant to another. The error of a step is kept below 1e-13 of the state, far below every error of an
/// estimate that the tests look for. Compiled once, in advance.cpp: Odeint costs seconds in each file that includes it.
void advance(std::vector<double>& state, double from, double to, const Derivative& derivative);

template <std::size_t N>
void advance(std::array<double, N>& state, double from, double to, const Derivative& derivative) {
    std::vector<double> x(state.begin(), state.end());
    advance(x, from, to, derivative);
    std::copy(x.begin(), x.end(), state.begin());
}

}  // namespace algest::plants
