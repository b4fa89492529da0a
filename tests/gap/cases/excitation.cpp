// SPDX-License-Identifier: GPL-3.0-or-later
#include "excitation.hpp"

#include <algorithm>
#include <cmath>

namespace algest::gap {

std::vector<double> sines(Random& random, std::size_t samples, double period, int count, double lowest, double highest) {
    std::vector<double> out(samples, 0.0);
    for (int c = 0; c < count; ++c) {
        // One frequency in each part of the band: no two sines beat as one.
        const double ratio = std::pow(highest / lowest, 1.0 / count);
        const double f = lowest * std::pow(ratio, c) * random.log_uniform(1.0, ratio);
        const double phase = random.uniform(0, 2 * M_PI);
        for (std::size_t k = 0; k < samples; ++k) {
            out[k] += std::sqrt(2.0 / count) * std::sin(2 * M_PI * f * period * static_cast<double>(k) + phase);
        }
    }
    return out;
}

std::vector<double> steps(Random& random, std::size_t samples, double period, double hold) {
    std::vector<double> out(samples, 0.0);
    double level = 0;
    std::size_t next = 0;
    for (std::size_t k = 0; k < samples; ++k) {
        if (k >= next) {
            level = random.uniform(-1, 1);
            next = k + std::max<std::size_t>(2, static_cast<std::size_t>(random.uniform(0.5, 1.5) * hold / period));
        }
        out[k] = level;
    }
    return out;
}

std::vector<double> excitation(Random& random, std::size_t samples, double period, double lowest, double highest) {
    const int kind = random.integer(0, 2);
    if (kind == 2) return steps(random, samples, period, 0.5 / std::sqrt(lowest * highest));
    std::vector<double> out = sines(random, samples, period, kind == 0 ? 7 : 3, lowest, highest);
    for (double& v : out) v *= kind == 0 ? 0.35 : 0.6;
    if (kind == 0) {
        const std::vector<double> level = steps(random, samples, period, 0.7 / lowest);
        for (std::size_t k = 0; k < samples; ++k) out[k] += 0.5 * level[k];
    }
    return out;
}

std::vector<double> scaled(std::vector<double> values, double factor, double offset) {
    for (double& v : values) v = offset + factor * v;
    return values;
}

}  // namespace algest::gap
