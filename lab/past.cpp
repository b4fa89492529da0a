// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/past.hpp"

#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

constexpr double rounding = 1e-9;   ///< of a sample
constexpr double longest = 1e15;    ///< samples: more than any recording has

}  // namespace

SamplesAgo samples_ago(double seconds, double period) {
    const double samples = std::clamp(seconds / period, 0.0, longest);
    const double whole = std::floor(samples + rounding);
    return {static_cast<std::size_t>(whole), samples - whole < rounding ? 0.0 : samples - whole};
}

double past_value(const std::vector<double>& samples, bool held, std::size_t at, double part, double since, SamplesAgo ago, double before) {
    const bool older = since + rounding < ago.rest;   // the newest sample that has passed is one sample further back
    const std::size_t back = ago.whole + (older ? 1 : 0);
    if (back > at) return before;
    const std::size_t k = std::min(at - back, samples.size() - 1);
    if (held || k + 1 >= samples.size()) return samples[k];
    return samples[k] + (part - ago.rest + (older ? 1 : 0)) * (samples[k + 1] - samples[k]);
}

std::vector<double> delayed_samples(const std::vector<double>& samples, SamplesAgo ago, double before) {
    const auto at = [&](std::size_t row, std::size_t back) { return row >= back ? samples[row - back] : before; };
    std::vector<double> out;
    for (std::size_t row = 0; row < samples.size(); ++row) out.push_back((1 - ago.rest) * at(row, ago.whole) + ago.rest * at(row, ago.whole + 1));
    return out;
}

double past_value(const MovingPast& past, SamplesAgo ago) {
    const std::size_t back = ago.whole + (ago.rest > 0 ? 1 : 0);
    if (back >= past.value.size()) return past.value.front();
    const std::size_t k = past.value.size() - 1 - back;
    if (!(ago.rest > 0)) return past.value[k];
    const double u = 1 - ago.rest;   // of the way from k to k + 1
    const double rise = past.value[k + 1] - past.value[k];
    const double behind = past.slope_ahead[k] - rise;
    const double ahead = past.slope_behind[k + 1] - rise;
    return past.value[k] + u * (rise + (1 - u) * ((1 - u) * behind - u * ahead));
}

}  // namespace algest::lab
