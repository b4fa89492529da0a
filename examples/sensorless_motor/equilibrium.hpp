// SPDX-License-Identifier: 0BSD
// The simulated stepper motor at steady speeds, driven by a voltage in the frame of the commanded angle: equations (10) to (14) of Delpoux, Bodson,
// Floquet 2014. Yours is the real one.
#pragma once
#include <cmath>
#include <vector>

namespace sensorless_motor {

struct Motor {
    double R = 2.9, L = 10.2e-3, K = 0.27, f_v = 2.4e-4, C_r = 0.0752, n_p = 50;
};

/// Means of one operating point in the f-g frame; the machine follows omega.
struct OperatingPoint {
    double omega, v_f, v_g, i_f, i_g;
};

/// At speed omega > 0 with a voltage of size V at the angle alpha. NaN where there is no equilibrium.
inline OperatingPoint equilibrium(const Motor& m, double omega, double V, double alpha) {
    const double reactance = m.L * m.n_p * omega;
    const double Z = std::hypot(m.R, reactance);
    const double beta = std::atan2(reactance, m.R);
    const double friction = m.f_v * omega + m.C_r;
    const double delta = std::asin((Z / m.K * friction + m.K * omega * std::cos(beta)) / V) - alpha + beta;
    return {omega, V * std::cos(alpha), V * std::sin(alpha), (V * std::cos(alpha - beta) - m.K * omega * std::sin(delta + beta)) / Z,
            (V * std::sin(alpha - beta) - m.K * omega * std::cos(delta + beta)) / Z};
}

/// Where V = min(20 (I_max - I), 30), equation (26): the largest such V, by bisection from above.
inline OperatingPoint controlled(const Motor& m, double omega, double I_max, double alpha) {
    const auto excess = [&](double V) {
        const OperatingPoint p = equilibrium(m, omega, V, alpha);
        return V - std::fmin(20 * (I_max - std::hypot(p.i_f, p.i_g)), 30);
    };
    double high = 30;
    if (excess(high) <= 0) return equilibrium(m, omega, high, alpha);
    double low = high;
    while (excess(low) > 0) low -= 0.01;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (excess(middle) > 0 ? high : low) = middle;
    }
    return equilibrium(m, omega, high, alpha);
}

/// Speeds 2 to 12 and 30 to 40 rad/s, four currents: 88 points.
inline std::vector<OperatingPoint> operating_points(const Motor& m, double alpha) {
    std::vector<OperatingPoint> out;
    for (int omega = 2; omega <= 40; ++omega) {
        if (omega > 12 && omega < 30) continue;
        for (const double I_max : {1.5, 2.0, 2.5, 3.0}) out.push_back(controlled(m, omega, I_max, alpha));
    }
    return out;
}

}  // namespace sensorless_motor
