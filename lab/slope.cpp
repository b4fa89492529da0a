// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/slope.hpp"

#include <algorithm>
#include <cmath>

namespace algest::lab {

std::vector<double> slopes(const std::vector<double>& x, double noise, double period) {
    constexpr double noise_of_a_slope = 0.03;   // of its rms
    std::vector<double> out(x.size(), 0.0);
    for (const std::size_t reach : {2U, 4U, 8U, 16U, 32U, 64U}) {
        if (x.size() < 2 * reach + 1) break;   // too short: what the reach before gave stays
        double weight = 0;   // sum of k^2 over the samples on both sides
        for (std::size_t k = 1; k <= reach; ++k) weight += 2.0 * static_cast<double>(k * k);
        double squares = 0;
        for (std::size_t row = 0; row < x.size(); ++row) {
            const std::size_t centre = std::clamp(row, reach, x.size() - 1 - reach);
            double slope = 0;
            for (std::size_t k = 1; k <= reach; ++k) slope += static_cast<double>(k) * (x[centre + k] - x[centre - k]);
            out[row] = slope / (weight * period);
            squares += out[row] * out[row];
        }
        const double rms = std::sqrt(squares / static_cast<double>(x.size()));
        if (noise / (std::sqrt(weight) * period) < noise_of_a_slope * rms) break;
    }
    return out;
}

}  // namespace algest::lab
