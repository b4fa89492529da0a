// SPDX-License-Identifier: GPL-3.0-or-later
// White noise that is the same on every machine.
#pragma once
#include <random>
#include <vector>

namespace algest::lab {

/// Adds samples of that standard deviation: sums of twelve uniform ones, which are normal enough. Cost: samples.
inline void add_white_noise(std::vector<double>& to, double deviation, std::mt19937& random) {
    for (double& value : to) {
        double sum = -6;
        for (int k = 0; k < 12; ++k) sum += static_cast<double>(random()) / 4294967296.0;
        value += deviation * sum;
    }
}

}  // namespace algest::lab
