// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/doubt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "lab/median.hpp"

namespace algest::lab {

namespace {

double number(const exact::Rational& x) { return exact::nearest(x, plan::Scalar::float64); }

/// The declared limit or sign that the value contradicts.
std::optional<std::string> contradicted(const model::Parameter& p, double value) {
    const Limits limits = limits_of(p);
    if (value < limits.min) return "min = " + exact::decimal(*p.min);
    if (value > limits.max) return "max = " + exact::decimal(*p.max);
    if (p.initial && value * number(*p.initial) < 0.0) return "the sign of initial = " + exact::decimal(*p.initial);
    return std::nullopt;
}

}  // namespace

Limits limits_of(const model::Parameter& parameter) {
    constexpr double none = std::numeric_limits<double>::infinity();
    return {parameter.min ? number(*parameter.min) : -none, parameter.max ? number(*parameter.max) : none};
}

std::optional<std::string> doubt(const model::Parameter& parameter, double value, std::optional<double> deviation) {
    const auto against = contradicted(parameter, value);
    const bool hardly = deviation && !(std::abs(value) >= told_from_zero * *deviation);
    if (!against && !hardly) return std::nullopt;
    std::string out = fmt::format("{} = {:.3g}", parameter.name, value);
    if (hardly) out += fmt::format(" is {:.2g} of its standard deviations and hardly told from zero", std::abs(value) / *deviation);
    if (against) out += fmt::format("{} contradicts {}", hardly ? ", and" : "", *against);
    return out;
}

std::optional<double> scatter_in_deviations(const Replay& replay, std::size_t p) {
    constexpr std::size_t fewest = 8;
    constexpr double normal = 1.4826;   // sd over the median of |error|
    if (replay.deviations.empty()) return std::nullopt;
    std::vector<std::size_t> known;
    std::vector<double> values;
    for (std::size_t k = 0; k < replay.samples(); ++k) {
        if (replay.status[k] != Status::ok || !(replay.deviation(k, p) > 0)) continue;
        known.push_back(k);
        values.push_back(replay.parameter(k, p));
    }
    if (known.size() < fewest) return std::nullopt;
    const double middle = *median(values);
    std::vector<double> off;
    for (const std::size_t k : known) off.push_back(std::abs(replay.parameter(k, p) - middle) / replay.deviation(k, p));
    return normal * *median(off);
}

}  // namespace algest::lab
