// SPDX-License-Identifier: 0BSD
// The rotor frame (d-q) and the stator frame (phases), and how a command of the one is held in the other.
#pragma once
#include <cmath>

namespace pmsm_drive {

struct RotorFrame {
    double d, q;
};

struct StatorFrame {
    double a, b;
};

/// Park's transformation, which leads from (20) to (21) of Delpoux, Floquet 2015. `angle` [rad] is electrical: n_p theta.
inline RotorFrame to_rotor_frame(const StatorFrame& x, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * x.a + s * x.b, c * x.b - s * x.a};
}

/// Its inverse.
inline StatorFrame to_stator_frame(const RotorFrame& x, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * x.d - s * x.q, s * x.d + c * x.q};
}

/// The phase voltages to hold over the coming period [s]. The rotor turns on meanwhile: the command is laid where the rotor
/// will be half a period from now, so that over the period it stands for what was meant, on average. `angle` [rad] and
/// `rate` [rad/s] are electrical.
inline StatorFrame held_in_stator_frame(const RotorFrame& command, double angle, double rate, double period) {
    return to_stator_frame(command, angle + 0.5 * rate * period);
}

/// What an estimator with hold = "zoh" is fed for such a command. While it is held it turns by phi = rate period in the rotor
/// frame, so that its mean is shorter by phi^2/24; and the currents bend between their samples, which the estimator takes for
/// straight: that costs phi^2/12 the other way (docs/stator-frame.md). Arguments as above.
inline RotorFrame fed_for_stator_hold(const RotorFrame& command, double rate, double period) {
    const double phi = rate * period;
    const double gain = 1.0 + phi * phi / 24.0;
    return {gain * command.d, gain * command.q};
}

}  // namespace pmsm_drive
