// SPDX-License-Identifier: GPL-3.0-or-later
// The integrator of all plants: Boost.Odeint, Runge-Kutta-Fehlberg 7(8) with controlled steps.
#pragma once
#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cstddef>
#include <vector>

namespace algest::plants {

/// Moves the state from one instant to another. derivative(x, dxdt, t). The error of a step is kept below 1e-13 of the
/// state, far below every error of an estimate that the tests look for.
template <std::size_t N, class Derivative>
void advance(std::array<double, N>& state, double from, double to, Derivative derivative) {
    namespace odeint = boost::numeric::odeint;
    using Vector = std::vector<double>;
    constexpr double absolute = 1e-18;  // the bearing moves by micrometres
    constexpr double relative = 1e-13;
    Vector x(state.begin(), state.end());
    odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_fehlberg78<Vector>>(absolute, relative),
                               derivative, x, from, to, to - from);
    std::copy(x.begin(), x.end(), state.begin());
}

}  // namespace algest::plants
