// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

constexpr int most_decimals = 12;

/// Power of ten of the first of two rounded digits: 0.0996 rounds to 0.10, so it is -1.
int leading_power(double value) {
    const std::string text = fmt::format("{:.1e}", std::abs(value));
    return std::stoi(text.substr(text.find('e') + 1));
}

}  // namespace

Quantity quantity(double value, double sd) {
    if (!std::isfinite(value)) return {"-", "", ""};
    const bool known = std::isfinite(sd) && sd > 0;
    const double larger = std::max(std::abs(value), known ? sd : 0.0);
    if (larger == 0) return {"0", "", ""};
    const int power = leading_power(larger);
    const int exponent = power >= -3 && power < 5 ? 0 : 3 * static_cast<int>(std::floor(power / 3.0));
    const double scale = std::pow(10.0, -exponent);
    Quantity out;
    if (exponent != 0) out.exponent = fmt::format("{}", exponent);
    if (!known) {
        out.value = fmt::format("{:.6g}", value * scale);
        return out;
    }
    const int by_deviation = exponent - leading_power(sd) + 1;
    const bool seen = value == 0 || std::abs(value) * scale >= 0.5 * std::pow(10.0, -by_deviation);
    const int decimals = std::clamp(seen ? by_deviation : exponent - leading_power(value), 0, most_decimals);
    out.value = fmt::format("{:.{}f}", value * scale, decimals);
    out.sd = fmt::format("{:.{}f}", sd * scale, decimals);
    return out;
}

std::string three_digits(double value) {
    if (!std::isfinite(value)) return "-";
    if (value == 0) return "0";
    const int power = leading_power(value);
    if (power < -4 || power > 6) return fmt::format("{:.2e}", value);
    return fmt::format("{:.{}f}", value, std::clamp(2 - power, 0, 6));
}

}  // namespace algest::lab
