// SPDX-License-Identifier: GPL-3.0-or-later
// A number for people: as many digits as its standard deviation allows, powers of ten taken out.
#pragma once
#include <string>

namespace algest::lab {

/// `value` and `sd` to be followed by 10^exponent; both have the same decimals.
struct Quantity {
    std::string value;
    std::string sd;         ///< empty: none is known (not finite) or there is none (0)
    std::string exponent;   ///< of ten, a multiple of 3; empty: 0
};

/// The standard deviation to two digits and the value to its last digit (a value that would then be 0 and is not: to its own first digit); six digits of a value without one. A value that is not
/// finite is "-".
Quantity quantity(double value, double sd);

/// Three significant digits without an exponent where that is shorter: 0.00407, 29.1, 12300.
std::string three_digits(double value);

}  // namespace algest::lab
