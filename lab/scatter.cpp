// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lab/median.hpp"

namespace algest::lab {

std::optional<double> scatter_in_deviations(const Replay& replay, std::size_t p) {
    constexpr std::size_t fewest = 8;
    constexpr double normal = 1.4826;   // sd over the median of |error|: 1 / 0.6745, the normal distribution's third quartile
    if (replay.deviations.empty()) return std::nullopt;
    const auto last = std::find(replay.status.rbegin(), replay.status.rend(), Status::ok);
    const std::size_t stride = deviation_stride(static_cast<std::size_t>(replay.status.rend() - last), deviations_for_scatter);
    std::vector<std::size_t> looked_at;
    std::vector<double> values;
    for (std::size_t k = 0; k < replay.samples(); k += stride) {
        if (replay.status[k] != Status::ok || !(replay.deviation(k, p) > 0)) continue;
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
