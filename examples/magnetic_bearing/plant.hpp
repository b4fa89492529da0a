// SPDX-License-Identifier: 0BSD
// The simulated shaft in its bearing, equations (34) and (35) of Delpoux, Floquet 2015, under currents that are held. Yours is the
// real one.
#pragma once
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <vector>

#include "magnets.hpp"

namespace magnetic_bearing {

struct State {
    Vector position{0.0, 0.0};  ///< m
    Vector velocity{0.0, 0.0};  ///< m/s
};

/// The state at `to` [s], from that at `from` [s]. perturbation(t) is a force on the shaft [N] that nobody measures.
/// Runge-Kutta-Fehlberg 7(8) with controlled steps.
template <class Perturbation>
State advance(const Bearing& bearing, const State& state, double from, double to, const PerMagnet& current,
              Perturbation perturbation) {
    namespace odeint = boost::numeric::odeint;
    using Four = std::vector<double>;                     // with std::array GCC takes the stepper for uninitialised
    constexpr double absolute = 1e-18, relative = 1e-13;  // the shaft moves by micrometres
    Four x{state.position.y, state.velocity.y, state.position.z, state.velocity.z};
    const auto rates = [&](const Four& s, Four& rate, double t) {
        Vector force = perturbation(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const double gap = air(bearing, k, {s[0], s[2]});
            const double pull = bearing.lambda[k] * current[k] * current[k] / (gap * gap);  // (32)
            force.y += direction[k].y * pull;
            force.z += direction[k].z * pull;
        }
        rate[0] = s[1];
        rate[1] = force.y / bearing.mass;
        rate[2] = s[3];
        rate[3] = force.z / bearing.mass;
    };
    odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_fehlberg78<Four>>(absolute, relative), rates, x,
                               from, to, to - from);
    return {{x[0], x[2]}, {x[1], x[3]}};
}

}  // namespace magnetic_bearing
