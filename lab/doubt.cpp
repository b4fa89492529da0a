// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/doubt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

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

bool hardly_told_from_zero(double value, double deviation) { return !(std::abs(value) >= told_from_zero * deviation); }

std::optional<std::string> doubt(const model::Parameter& parameter, double value, std::optional<double> deviation) {
    const auto against = contradicted(parameter, value);
    const bool hardly = deviation && hardly_told_from_zero(value, *deviation);
    if (!against && !hardly) return std::nullopt;
    std::string out = fmt::format("{} = {:.3g}", parameter.name, value);
    if (hardly) out += fmt::format(" is {:.2g} of its standard deviations and hardly told from zero", std::abs(value) / *deviation);
    if (against) out += fmt::format("{} contradicts {}", hardly ? ", and" : "", *against);
    return out;
}

}  // namespace algest::lab
