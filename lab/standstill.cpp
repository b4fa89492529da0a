// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/standstill.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

using Samples = std::vector<double>;

constexpr std::size_t fewest = 50;   ///< samples from which on noise can be told from motion
constexpr double sure = 4.0;         ///< standard deviations: one white signal in 30000 is not seen as one
constexpr std::size_t most_lag = 2;  ///< samples by which what follows a command follows at once

/// Less its mean, over its rms; empty where it is constant.
Samples normalised(Samples x) {
    const double n = static_cast<double>(x.size());
    double mean = 0.0, square = 0.0;
    for (const double value : x) mean += value / n;
    for (double& value : x) value -= mean;
    for (const double value : x) square += value * value / n;
    const double size = std::sqrt(square);
    if (!(size > 1e-12 * std::abs(mean))) return {};   // the mean's own rounding
    for (double& value : x) value /= size;
    return x;
}

/// Mean of x_k y_(k+lag) of normalised signals: about 1/sqrt(n) where they are white and unrelated.
double correlation(const Samples& x, const Samples& y, std::size_t lag) {
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < x.size(); ++k) sum += x[k] * y[k + lag];
    return sum / static_cast<double>(x.size());
}

}  // namespace

std::optional<std::string> standstill(const plan::Plan& plan, const Recording& recording, const Stretch& stretch) {
    Diagnostics said_before;   // the plan was replayed
    std::vector<std::vector<double>> inputs;
    const RowRange rows = rows_of(recording, stretch);
    if (plan.steady || rows.size() < fewest || !read_inputs(plan, recording, inputs, said_before)) return std::nullopt;
    const double bound = sure / std::sqrt(static_cast<double>(rows.size()));
    std::vector<Samples> scattering;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const Samples x = normalised({inputs[i].begin() + static_cast<std::ptrdiff_t>(rows.begin), inputs[i].begin() + static_cast<std::ptrdiff_t>(rows.end)});
        if (x.empty()) continue;
        for (std::size_t lag = 1; lag <= most_lag; ++lag) if (std::abs(correlation(x, x, lag)) > bound) return std::nullopt;
        for (const Samples& other : scattering) {
            for (std::size_t lag = 0; lag <= most_lag; ++lag) if (std::abs(correlation(x, other, lag)) > bound || std::abs(correlation(other, x, lag)) > bound) return std::nullopt;
        }
        scattering.push_back(x);
        names.push_back(plan.inputs[i].name);
    }
    if (names.empty()) return std::nullopt;
    return fmt::format("nothing moves but noise: {} {} about {}, all else is constant; estimates of this stretch rest on the noise, whatever their status", fmt::join(names, ", "),
                       names.size() == 1 ? "scatters" : "scatter", names.size() == 1 ? "a constant" : "constants");
}

}  // namespace algest::lab
