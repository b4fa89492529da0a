// SPDX-License-Identifier: GPL-3.0-or-later
// A linear axis with friction, M q'' + Fv q' + Fc sgn(q') + offset = force, in a position loop like that of the EMPS
// benchmark (../shared/recordings/README.md, with its published parameters). The force acts from its sample to the next.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/plants/advance.hpp"

namespace algest::plants {

struct PositioningAxis {
    double M = 95.11;       ///< kg
    double Fv = 203.5;      ///< N.s/m
    double Fc = 20.39;      ///< N
    double offset = -3.16;  ///< N
    double period = 1e-3;   ///< s
};

struct AxisSample {
    double q;      ///< m, at this sample
    double force;  ///< N, from this sample to the next
};

/// Back and forth by 0.1 m in 2 s, with some of the fifth harmonic so that the mass shows.
inline std::vector<AxisSample> simulate(const PositioningAxis& axis, int samples) {
    using std::numbers::pi;
    std::array<double, 2> state{0.0, 0.0};  // q, q'
    std::vector<AxisSample> out;
    for (int k = 0; k < samples; ++k) {
        const double t0 = k * axis.period;
        const double wanted = 0.05 * (1.0 - std::cos(pi * t0)) + 0.004 * (1.0 - std::cos(5.0 * pi * t0));
        const double wanted_rate = 0.05 * pi * std::sin(pi * t0) + 0.004 * 5.0 * pi * std::sin(5.0 * pi * t0);
        const double force = axis.M * (60.0 * 60.0 * (wanted - state[0]) + 100.0 * (wanted_rate - state[1]));
        out.push_back({state[0], force});
        advance(state, t0, t0 + axis.period, [&](const auto& x, auto& dxdt, double) {
            // the corner of sgn is rounded within 1e-5 m/s, a thousandth of what the axis moves at
            const double friction = axis.Fv * x[1] + axis.Fc * std::tanh(x[1] / 1e-5) + axis.offset;
            dxdt[0] = x[1];
            dxdt[1] = (force - friction) / axis.M;
        });
    }
    return out;
}

}  // namespace algest::plants
