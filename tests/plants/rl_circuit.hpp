// SPDX-License-Identifier: GPL-3.0-or-later
// L i' = v - R i, with a voltage that is held between samples.
#pragma once
#include <functional>
#include <vector>

#include "tests/plants/advance.hpp"

namespace algest::plants {

struct RlCircuit {
    double R = 3.01;       ///< ohm
    double L = 9e-3;       ///< H
    double period = 1e-4;  ///< s
    double i0 = 0.0;       ///< A, at the first sample
};

struct RlSample {
    double v;  ///< V, from this sample to the next
    double i;  ///< A, at this sample
};

/// voltage(k) acts from sample k to sample k + 1.
inline std::vector<RlSample> simulate(const RlCircuit& plant, int samples, const std::function<double(int)>& voltage) {
    std::vector<RlSample> out;
    std::array<double, 1> state{plant.i0};
    for (int k = 0; k < samples; ++k) {
        const double v = voltage(k);
        out.push_back({v, state[0]});
        advance(state, k * plant.period, (k + 1) * plant.period,
                [&](const auto& x, auto& dxdt, double) { dxdt[0] = (v - plant.R * x[0]) / plant.L; });
    }
    return out;
}

}  // namespace algest::plants
