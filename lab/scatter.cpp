// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lab/median.hpp"

namespace algest::lab {

namespace {

constexpr double normal = 1.4826;   // sd over the median of |error|: 1 / 0.6745, the normal distribution's third quartile

}  // namespace

double spread(const Replay& replay, std::size_t p) {
    std::vector<double> values;
    for (std::size_t k = 0; k < replay.samples(); ++k) if (replay.status[k] == Status::ok) values.push_back(replay.parameter(k, p));
    const double middle = median(values).value_or(0.0);
    for (double& v : values) v = std::abs(v - middle);
    return normal * median(values).value_or(0.0);
}

std::optional<double> scatter_in_deviations(const Replay& replay, std::size_t p) {
    constexpr std::size_t fewest = 8;
    if (replay.deviations.empty()) return std::nullopt;
    const std::size_t stride = deviation_stride(static_cast<std::size_t>(std::count(replay.status.begin(), replay.status.end(), Status::ok)), deviations_for_scatter);
    std::size_t ok = 0;
    std::vector<std::size_t> looked_at;
    std::vector<double> values;
    for (std::size_t k = 0; k < replay.samples(); ++k) {
        if (replay.status[k] != Status::ok || ok++ % stride != 0 || !(replay.deviation(k, p) > 0)) continue;
        looked_at.push_back(k);
        values.push_back(replay.parameter(k, p));
    }
    if (looked_at.size() < fewest) return std::nullopt;
    const double middle = *median(values);
    std::vector<double> off;
    for (const std::size_t k : looked_at) off.push_back(std::abs(replay.parameter(k, p) - middle) / replay.deviation(k, p));
    return normal * *median(off);
}

}  // namespace algest::lab
