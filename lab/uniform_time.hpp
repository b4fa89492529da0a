// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the instants of a recording are uniform, as far as the decimals in the file can tell.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace algest::lab {

/// How finely a column of numbers is written: the largest number of decimals and of significant digits in it.
/// Both are needed: "%.3f" keeps the decimals, "%g" and C++ streams keep the significant digits.
struct WrittenDigits {
    int decimals = 0;
    int significant = 1;

    /// Takes one number as it stands in the file, e.g. "0.001", "1e-05". Cost: its length.
    void include(std::string_view number);
    /// Unit of the last digit in which a value of this column is written.
    double last_digit(double value) const;
};

/// What instants have to be.
enum class TimeBase { uniform, increasing };

struct UniformTime {
    double period;       ///< mean step
    double uncertainty;  ///< of the period, from rounding the first and the last instant; 0 where no step shows rounding
    bool uniform = true; ///< false only where TimeBase::increasing was asked for: then steps differ
};

/// The first step that breaks the rule, and how many do.
struct UnevenStep {
    std::size_t row;  ///< the step ends at this row (0: the first)
    double step;
    double period;  ///< of the others
    std::size_t count;
};

struct TimeCheck {
    std::optional<UniformTime> uniform;
    std::optional<UnevenStep> uneven;  ///< set if uniform is not
};

/// The rule: with P the mean of the steps near the median step, every step is P to one part in a thousand. Where t is
/// written with few digits, a step may besides be off by 0.9 units of its last digit (a uniform clock, rounded, gives
/// steps of two neighbouring values), provided that this unit is at most a tenth of the step: beyond that, rounding
/// could hide a missing sample. P must be positive. Needs two rows or more. Cost: rows * log(rows).
TimeCheck check_uniform(const std::vector<double>& t, const WrittenDigits& digits);

/// The same; or, where that is all that is asked for, whether t increases.
TimeCheck check_time(const std::vector<double>& t, const WrittenDigits& digits, TimeBase base);

}  // namespace algest::lab
