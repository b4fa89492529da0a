// SPDX-License-Identifier: GPL-3.0-or-later
// The third-order DC motor of Tian, Floquet, Perruquetti (003), equation (16) with a1 y' as errata.md corrects it:
// y''' + a2 y'' + a1 y' + a0 y = b0 u, with u = 24 sin t. The states of the paper are angle, speed and current: x3(0) = 3 A
// stands for y''(0) = K1/J x3(0) with K1 = 1 and J = 5.
#pragma once
#include <cmath>
#include <vector>

#include "tests/plants/advance.hpp"

namespace algest::plants {

struct DcMotor {
    double a0 = 0.0, a1 = 4.0, a2 = 10.0, b0 = 2.0;
    double period = 1e-3;                              ///< s
    std::array<double, 3> start{1.0, 0.0, 3.0 / 5.0};  ///< y [rad], y', y''
};

struct DcMotorSample {
    double y;  ///< rad
    double u;  ///< V
};

inline std::vector<DcMotorSample> simulate(const DcMotor& plant, int samples) {
    const auto voltage = [](double t) { return 24.0 * std::sin(t); };
    std::array<double, 3> state = plant.start;
    std::vector<DcMotorSample> out;
    for (int k = 0; k < samples; ++k) {
        out.push_back({state[0], voltage(k * plant.period)});
        advance(state, k * plant.period, (k + 1) * plant.period, [&](const auto& x, auto& dxdt, double t) {
            dxdt[0] = x[1];
            dxdt[1] = x[2];
            dxdt[2] = plant.b0 * voltage(t) - plant.a2 * x[2] - plant.a1 * x[1] - plant.a0 * x[0];
        });
    }
    return out;
}

}  // namespace algest::plants
