// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/plants/advance.hpp"

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

namespace algest::plants {

void advance(std::vector<double>& state, double from, double to, const Derivative& derivative) {
    namespace odeint = boost::numeric::odeint;
    constexpr double absolute = 1e-18;  // the bearing moves by micrometres
    constexpr double relative = 1e-13;
    odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_fehlberg78<std::vector<double>>>(absolute, relative), derivative, state, from,
                               to, to - from);
}

}  // namespace algest::plants
