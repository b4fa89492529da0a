// SPDX-License-Identifier: GPL-3.0-or-later
// Exact numbers: reading decimals, printing fractions, and the one rounding at the end.
#pragma once
#include <cln/integer.h>
#include <cln/rational.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "generator/plan.hpp"

namespace algest::exact {

using Integer = cln::cl_I;
using Rational = cln::cl_RA;

/// A decimal ("0.1", "2.5e-3") or a fraction of two ("1/3"), exactly; nullopt if the text is neither, a denominator is
/// zero, or an exponent is beyond +-400.
std::optional<Rational> parse(std::string_view text);

/// The decimal that a person meant by this double: its shortest one, read exactly (0.1 is 1/10). The value must be finite.
Rational from_double(double value);

bool is_integer(const Rational& value);

/// "-1/6", "3".
std::string text(const Rational& value);

/// The same in LaTeX: "-\tfrac{1}{6}", "3".
std::string latex(const Rational& value);

/// Reads what text() wrote, of any length.
Rational from_text(const std::string& text);

/// "0.0001" where the decimal ends, else the fraction "1/3"; for people.
std::string decimal(const Rational& value);

/// The nearest double to numerator/denominator (denominator > 0), ties to even, denormals included; +-infinity beyond range.
double nearest_double(const Integer& numerator, const Integer& denominator);
/// The nearest float, likewise, in one rounding.
float nearest_float(const Integer& numerator, const Integer& denominator);
/// The nearest number of the scalar, as a double.
double nearest(const Rational& value, plan::Scalar scalar);
double nearest(const Integer& numerator, const Integer& denominator, plan::Scalar scalar);

/// The two numbers of the scalar whose sum is nearest: the nearest, and the nearest to what it leaves. The value must be in the scalar's range.
struct TwoParts {
    double high;
    double low;
};
TwoParts nearest_two(const Rational& value, plan::Scalar scalar);

/// "0x1.8p-3": every double has one such text; denormals have a leading 1 and a smaller exponent, zero is "0x0p+0".
std::string hexadecimal(double value);
void append_hexadecimal(double value, std::string& out);

/// The power of two nearest to sqrt(value) on a logarithmic scale. value > 0.
Rational power_of_two_near_root(const Rational& value);

/// x^exponent; x != 0 if exponent < 0.
Rational power(const Rational& x, int exponent);

/// Value of a formula of constants to 60 digits, for functions whose value is not rational: name is one of
/// sin cos tan exp log sqrt. Nullopt where it is not real and finite.
std::optional<Rational> function_value(const std::string& name, const Rational& argument);
/// base^exponent to 60 digits, base > 0.
std::optional<Rational> real_power(const Rational& base, const Rational& exponent);

}  // namespace algest::exact
