// SPDX-License-Identifier: GPL-3.0-or-later
// A physical pendulum that swings freely: theta'' = gravity sin(theta) - damping theta', theta = 0 on its head.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/plants/advance.hpp"

namespace algest::plants {

struct Pendulum {
    double gravity = 64.1;                  ///< 1/s^2, m g a / J of the recording
    double damping = 0.06;                  ///< 1/s
    double period = 1e-3;                   ///< s
    double start = std::numbers::pi / 2.0;  ///< rad, at rest
};

/// theta at each sample.
inline std::vector<double> simulate(const Pendulum& plant, int samples) {
    std::array<double, 2> state{plant.start, 0.0};
    std::vector<double> out;
    for (int k = 0; k < samples; ++k) {
        out.push_back(state[0]);
        advance(state, k * plant.period, (k + 1) * plant.period, [&](const auto& x, auto& dxdt, double) {
            dxdt[0] = x[1];
            dxdt[1] = plant.gravity * std::sin(x[0]) - plant.damping * x[1];
        });
    }
    return out;
}

}  // namespace algest::plants
