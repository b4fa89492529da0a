// SPDX-License-Identifier: 0BSD
// How the simulated motor moves, equation (21) of Delpoux, Floquet 2015, under voltages that are held.
#pragma once
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <vector>

#include "motor.hpp"

namespace pmsm_drive {

/// The state `duration` [s] later. voltage(theta) is what acts at that angle, in the rotor frame [V]. Runge-Kutta-Fehlberg
/// 7(8) with controlled steps: the error stays far below anything that an estimate could show.
template <class Voltage>
State advance_under(const Motor& motor, const State& from, double duration, Voltage voltage) {
    namespace odeint = boost::numeric::odeint;
    using Vector = std::vector<double>;  // with std::array GCC takes the stepper for uninitialised
    constexpr double tolerance = 1e-13;  // of a step, absolute and relative
    Vector x{from.current.d, from.current.q, from.omega, from.theta};
    const auto rates = [&](const Vector& s, Vector& rate, double) {
        const double i_d = s[0], i_q = s[1], omega = s[2];
        const RotorFrame v = voltage(s[3]);
        rate[0] = (v.d - motor.R * i_d + motor.n_p * motor.L * omega * i_q) / motor.L;
        rate[1] = (v.q - motor.R * i_q - motor.n_p * motor.L * omega * i_d - motor.K * omega) / motor.L;
        rate[2] = (motor.K * i_q - motor.friction(omega)) / motor.J;
        rate[3] = omega;
    };
    odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_fehlberg78<Vector>>(tolerance, tolerance), rates,
                               x, 0.0, duration, duration);
    return {{x[0], x[1]}, x[2], x[3]};
}

/// Under a voltage that turns with the rotor.
inline State advance(const Motor& motor, const State& from, double duration, const RotorFrame& held) {
    return advance_under(motor, from, duration, [&](double) { return held; });
}

/// Under phase voltages that stand still, as those of an inverter.
inline State advance(const Motor& motor, const State& from, double duration, const StatorFrame& held) {
    return advance_under(motor, from, duration, [&](double theta) { return to_rotor_frame(held, motor.n_p * theta); });
}

}  // namespace pmsm_drive
