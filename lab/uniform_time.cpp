// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/uniform_time.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>

namespace algest::lab {

namespace {

constexpr double relative_tolerance = 1e-3;
constexpr double rounding_tolerance = 0.9;  // units of the last digit
constexpr double coarsest_digit = 0.1;      // of the period

/// Unit of the last digit of the step that ends at row k; zero where it is too coarse to excuse anything.
double step_digit(const std::vector<double>& t, std::size_t k, double period, const WrittenDigits& digits) {
    const double last_digit = std::max(digits.last_digit(t[k - 1]), digits.last_digit(t[k]));
    return last_digit <= coarsest_digit * period ? last_digit : 0.0;
}

/// By how much that step may be off were t written in full: one part in a thousand, and the rounding of double.
double exact_tolerance(const std::vector<double>& t, std::size_t k, double period) {
    return relative_tolerance * period +
           4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t[k - 1]), std::abs(t[k]));
}

double median_step(const std::vector<double>& t) {
    std::vector<double> steps(t.size() - 1);
    for (std::size_t k = 1; k < t.size(); ++k) steps[k - 1] = t[k] - t[k - 1];
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

/// Mean of the steps that are the median's, or its neighbour by one digit.
double mean_near(double median, const std::vector<double>& t, const WrittenDigits& digits) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 1; k < t.size(); ++k) {
        const double step = t[k] - t[k - 1];
        if (std::abs(step - median) > exact_tolerance(t, k, median) + step_digit(t, k, median, digits)) continue;
        sum += step;
        count += 1.0;
    }
    return sum / count;
}

}  // namespace

void WrittenDigits::include(std::string_view number) {
    int after_point = 0;
    int count = 0;
    bool point = false;
    std::size_t k = 0;
    for (; k < number.size() && number[k] != 'e' && number[k] != 'E'; ++k) {
        if (number[k] == '.') point = true;
        if (number[k] < '0' || number[k] > '9') continue;
        if (point) ++after_point;
        if (count > 0 || number[k] != '0') ++count;
    }
    int exponent = 0;
    if (k < number.size()) {
        ++k;
        if (k < number.size() && number[k] == '+') ++k;
        std::from_chars(number.data() + k, number.data() + number.size(), exponent);
    }
    decimals = std::max(decimals, after_point - exponent);
    significant = std::max(significant, count);
}

double WrittenDigits::last_digit(double value) const {
    const double fixed = std::pow(10.0, -decimals);
    if (value == 0.0) return fixed;
    return std::max(fixed, std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1.0 - significant));
}

TimeCheck check_uniform(const std::vector<double>& t, const WrittenDigits& digits) {
    const double median = median_step(t);
    const double period = median > 0.0 ? mean_near(median, t, digits) : median;
    UnevenStep uneven{0, 0.0, period, 0};
    bool rounded = false;
    for (std::size_t k = 1; k < t.size(); ++k) {
        const double step = t[k] - t[k - 1];
        const double off = std::abs(step - period);
        if (step > 0.0 && off <= exact_tolerance(t, k, period)) continue;
        if (step > 0.0 && off <= rounding_tolerance * step_digit(t, k, period, digits)) {
            rounded = true;
            continue;
        }
        if (uneven.count == 0) {
            uneven.row = k;
            uneven.step = step;
        }
        ++uneven.count;
    }
    if (uneven.count > 0) return {std::nullopt, uneven};
    const double steps = static_cast<double>(t.size() - 1);
    const double rounding = !rounded ? 0.0 : (digits.last_digit(t.front()) + digits.last_digit(t.back())) / 2.0;
    return {UniformTime{(t.back() - t.front()) / steps, rounding / steps, true}, std::nullopt};
}

TimeCheck check_time(const std::vector<double>& t, const WrittenDigits& digits, TimeBase base) {
    const TimeCheck check = check_uniform(t, digits);
    if (check.uniform || base == TimeBase::uniform) return check;
    const auto back = std::adjacent_find(t.begin(), t.end(), std::greater_equal<>());
    if (back != t.end()) return {std::nullopt, UnevenStep{static_cast<std::size_t>(back - t.begin()) + 1, back[1] - back[0], 0.0, 1}};
    return {UniformTime{(t.back() - t.front()) / static_cast<double>(t.size() - 1), 0.0, false}, std::nullopt};
}

}  // namespace algest::lab
