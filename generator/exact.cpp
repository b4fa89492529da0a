// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/exact.hpp"

#include <cln/float.h>
#include <cln/integer_io.h>
#include <cln/io.h>
#include <cln/lfloat.h>
#include <cln/rational_io.h>
#include <cln/real.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace algest::exact {

namespace {

constexpr int largest_decimal_exponent = 400;
constexpr std::size_t most_digits = 400;
constexpr int working_digits = 60;

Integer integer_text(const std::string& digits) {
    // CLN's reader takes a decimal string without a sign.
    return Integer(digits.empty() ? "0" : digits.c_str());
}

/// Nullopt unless both numbers of the fraction can be read again: a decimal with few digits and a large exponent has many.
std::optional<Rational> of_readable_size(const Rational& value) {
    static const Integer limit = cln::expt_pos(Integer(10), Integer(static_cast<unsigned long>(most_digits)));
    if (cln::abs(cln::numerator(value)) >= limit || cln::denominator(value) >= limit) return std::nullopt;
    return value;
}

std::optional<Rational> parse_decimal(std::string_view text) {
    std::size_t i = 0;
    bool negative = false;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) negative = text[i++] == '-';
    std::string digits;
    int scale = 0;
    bool point = false;
    bool any = false;
    for (; i < text.size(); ++i) {
        const char c = text[i];
        if (c >= '0' && c <= '9') {
            any = true;
            digits += c;
            if (point) --scale;
            if (digits.size() > most_digits) return std::nullopt;
        } else if (c == '.' && !point) {
            point = true;
        } else {
            break;
        }
    }
    if (!any) return std::nullopt;
    if (i < text.size()) {
        if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
        ++i;
        if (i < text.size() && text[i] == '+' && ++i < text.size() && text[i] == '-') return std::nullopt;
        int exponent = 0;
        const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), exponent);
        if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
        if (exponent > largest_decimal_exponent || exponent < -largest_decimal_exponent) return std::nullopt;
        scale += exponent;
    }
    Rational value = integer_text(digits);
    const Integer ten_power = cln::expt_pos(Integer(10), Integer(std::abs(scale) == 0 ? 1 : std::abs(scale)));
    if (scale > 0) value = value * ten_power;
    if (scale < 0) value = value / ten_power;
    return of_readable_size(negative ? -value : value);
}

/// Rounds |numerator| / denominator to `digits` bits with smallest exponent `lowest` of the last bit; result = integer * 2^shift.
double nearest_binary(const Integer& numerator, const Integer& denominator, int digits, int lowest) {
    if (cln::zerop(numerator)) return 0.0;
    const bool negative = cln::minusp(numerator);
    const Integer n = cln::abs(numerator);
    // Exponent e with 2^e <= n/d < 2^(e+2); the quotient keeps digits or digits + 1 bits and is corrected below.
    long e = static_cast<long>(cln::integer_length(n)) - static_cast<long>(cln::integer_length(denominator)) - 1;
    const auto quotient = [&](long shift) {
        return shift < 0 ? cln::floor2(cln::ash(n, -shift), denominator) : cln::floor2(n, cln::ash(denominator, shift));
    };
    long shift = e - digits + 1;
    if (shift < lowest) shift = lowest;
    cln::cl_I_div_t division = quotient(shift);
    if (static_cast<long>(cln::integer_length(division.quotient)) > digits) {
        ++shift;
        division = quotient(shift);
    }
    const Integer scaled_denominator = shift < 0 ? denominator : cln::ash(denominator, shift);
    const Integer twice = cln::ash(division.remainder, 1);
    Integer mantissa = division.quotient;
    const auto side = cln::compare(twice, scaled_denominator);
    if (side > 0 || (side == 0 && cln::oddp(mantissa))) mantissa = mantissa + 1;
    // At most `digits` bits plus a carry to a power of two: exact in a double.
    const double value = std::ldexp(cln::double_approx(mantissa), static_cast<int>(std::min(shift, 5000L)));
    return negative ? -value : value;
}

std::optional<Rational> from_float(const cln::cl_F& value) { return cln::rational(value); }

}  // namespace

std::optional<Rational> parse(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return parse_decimal(text);
    const auto trim = [](std::string_view s) {
        while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
        while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
        return s;
    };
    const auto above = parse_decimal(trim(text.substr(0, slash)));
    const auto below = parse_decimal(trim(text.substr(slash + 1)));
    if (!above || !below || cln::zerop(*below)) return std::nullopt;
    return of_readable_size(*above / *below);
}

Rational from_double(double value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
    (void)error;
    return *parse_decimal(std::string_view(buffer, static_cast<std::size_t>(end - buffer)));
}

bool is_integer(const Rational& value) { return cln::denominator(value) == 1; }

std::string text(const Rational& value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::string latex(const Rational& value) {
    if (is_integer(value)) return text(value);
    const std::string fraction = "\\tfrac{" + text(cln::abs(cln::numerator(value))) + "}{" + text(cln::denominator(value)) + "}";
    return cln::minusp(value) ? "-" + fraction : fraction;
}

Rational from_text(const std::string& text) { return Rational(text.c_str()); }

std::string decimal(const Rational& value) {
    // A decimal ends where the denominator divides a power of ten.
    Integer rest = cln::denominator(value);
    int places = 0;
    for (const int factor : {2, 5}) {
        int powers = 0;
        while (cln::zerop(cln::mod(rest, factor))) {
            rest = cln::exquo(rest, factor);
            ++powers;
        }
        places = std::max(places, powers);
    }
    if (rest != 1 || places > 20) return text(value);
    if (places == 0) return text(value);
    const Rational shifted = cln::abs(value) * cln::expt_pos(Integer(10), static_cast<unsigned>(places));
    std::string digits = text(shifted);
    if (digits.size() <= static_cast<std::size_t>(places)) digits.insert(0, static_cast<std::size_t>(places) + 1 - digits.size(), '0');
    digits.insert(digits.size() - static_cast<std::size_t>(places), ".");
    return cln::minusp(value) ? "-" + digits : digits;
}

double nearest_double(const Integer& numerator, const Integer& denominator) {
    return nearest_binary(numerator, denominator, 53, -1074);
}

float nearest_float(const Integer& numerator, const Integer& denominator) {
    return static_cast<float>(nearest_binary(numerator, denominator, 24, -149));
}

double nearest(const Integer& numerator, const Integer& denominator, plan::Scalar scalar) {
    return scalar == plan::Scalar::float64 ? nearest_double(numerator, denominator)
                                           : static_cast<double>(nearest_float(numerator, denominator));
}

double nearest(const Rational& value, plan::Scalar scalar) {
    return nearest(cln::numerator(value), cln::denominator(value), scalar);
}

TwoParts nearest_two(const Rational& value, plan::Scalar scalar) {
    const double high = nearest(value, scalar);
    int exponent = 0;
    const double mantissa = std::frexp(high, &exponent);
    const Rational exactly = Rational(static_cast<long>(std::ldexp(mantissa, 53))) * power(Rational(2), exponent - 53);
    return {high, nearest(value - exactly, scalar)};
}

std::string hexadecimal(double value) {
    std::string out;
    append_hexadecimal(value, out);
    return out;
}

void append_hexadecimal(double value, std::string& out) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    out += (bits >> 63) != 0 ? "-0x" : "0x";
    std::uint64_t fraction = bits & 0xFFFFFFFFFFFFFULL;
    int exponent = static_cast<int>((bits >> 52) & 0x7FF);
    if (exponent == 0 && fraction == 0) {
        out += "0p+0";
        return;
    }
    if (exponent == 0) {
        exponent = -1022;
        while ((fraction & (1ULL << 52)) == 0) {
            fraction <<= 1;
            --exponent;
        }
        fraction &= 0xFFFFFFFFFFFFFULL;
    } else {
        exponent -= 1023;
    }
    out += '1';
    if (fraction != 0) {
        out += '.';
        while (fraction != 0) {
            out += "0123456789abcdef"[(fraction >> 48) & 0xF];
            fraction = (fraction << 4) & 0xFFFFFFFFFFFFFULL;
        }
    }
    out += 'p';
    out += exponent < 0 ? '-' : '+';
    char digits[8];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, std::abs(exponent));
    (void)error;
    out.append(digits, end);
}

Rational power_of_two_near_root(const Rational& value) {
    // 2^k <= sqrt(value) < 2^(k+1), then the nearer one on a logarithmic scale: compare value with 2^(2k+1).
    long k = 0;
    const Rational four = 4;
    Rational bound = 1;   // 4^k
    while (bound * four <= value) { bound = bound * four; ++k; }
    while (bound > value) { bound = bound / four; --k; }
    if (value >= bound * 2) ++k;
    return power(Rational(2), static_cast<int>(k));
}

Rational power(const Rational& x, int exponent) {
    if (exponent == 0) return 1;
    const Rational positive = cln::expt_pos(x, Integer(std::abs(exponent)));
    return exponent > 0 ? positive : 1 / positive;
}

std::optional<Rational> function_value(const std::string& name, const Rational& argument) {
    const cln::cl_F x = cln::cl_float(argument, cln::float_format(working_digits));
    if (name == "sqrt") return cln::minusp(argument) ? std::nullopt : from_float(cln::sqrt(x));
    if (name == "log") return cln::plusp(argument) ? from_float(cln::ln(x)) : std::nullopt;
    if (name == "exp") {
        if (cln::abs(argument) > 1000) return std::nullopt;
        return from_float(cln::exp(x));
    }
    if (cln::abs(argument) > 1000000) return std::nullopt;
    if (name == "sin") return from_float(cln::sin(x));
    if (name == "cos") return from_float(cln::cos(x));
    if (name == "tan") return from_float(cln::tan(x));
    return std::nullopt;
}

std::optional<Rational> real_power(const Rational& base, const Rational& exponent) {
    const auto log = function_value("log", base);
    return log ? function_value("exp", *log * exponent) : std::nullopt;
}

}  // namespace algest::exact
