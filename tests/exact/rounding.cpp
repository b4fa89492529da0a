// SPDX-License-Identifier: GPL-3.0-or-later
// The one rounding at the end, against Python's fractions; and the texts of exact numbers there and back.
#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <cln/integer_io.h>

#include "generator/exact.hpp"
#include "generator/wide_integer.hpp"
#include "tests/lab/temporary_file.hpp"

namespace algest {

namespace {

using exact::Integer;
using exact::Rational;

using Quotient = std::pair<Integer, Integer>;

Integer two_to(int exponent) { return cln::ash(Integer(1), exponent); }

std::string hexadecimal_integer(const Integer& value) {
    std::ostringstream out;
    cln::fprinthexadecimal(out, value);
    return out.str();
}

std::string bits(double value) {
    char out[17];
    std::snprintf(out, sizeof out, "%016llx", static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
    return out;
}

std::string bits(float value) {
    char out[9];
    std::snprintf(out, sizeof out, "%08x", std::bit_cast<std::uint32_t>(value));
    return out;
}

/// Quotients that are hard to round; the same ones on every run.
class Quotients {
public:
    std::vector<Quotient> take() {
        anything();
        for (const auto& [digits, least] : {std::pair{53, -1074}, std::pair{24, -149}}) {
            halfway(digits, least);
            denormal(least);
        }
        overflow(1024, 53);
        overflow(128, 24);
        return std::move(out_);
    }

private:
    Integer random_integer(int length) {
        Integer out = 1;
        for (int k = 1; k < length; ++k) out = 2 * out + static_cast<int>(random_() & 1);
        return out;
    }
    int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    void add(Integer numerator, Integer denominator) {
        out_.emplace_back(numerator, denominator);
        out_.emplace_back(-numerator, denominator);
    }
    /// numerator/denominator 2^exponent
    void add(const Integer& numerator, const Integer& denominator, int exponent) {
        if (exponent >= 0)
            add(cln::ash(numerator, exponent), denominator);
        else
            add(numerator, cln::ash(denominator, -exponent));
    }

    void anything() {
        add(0, 1);
        add(0, 7);
        for (int k = 0; k < 1500; ++k) add(random_integer(between(1, 300)), random_integer(between(1, 300)));
        for (int k = 0; k < 500; ++k)
            add(random_integer(between(1, 80)), random_integer(between(1, 80)), between(-1200, 1100));
        for (int k = 0; k < 50; ++k) add(random_integer(between(1900, 2600)), random_integer(between(1900, 2600)));
    }

    /// Halfway between neighbours, and off it by less and less: what a rounding in two steps gets wrong.
    void halfway(int digits, int least) {
        for (int k = 0; k < 300; ++k) {
            const Integer odd = 2 * random_integer(digits) + 1;
            const int exponent = k % 3 == 0 ? between(least, least + 3) : between(-100, 60);
            add(odd, 1, exponent);
            for (const int distance : {60, 64, 65, 74, 75, 76, 104, 128, 129, 200}) {
                const Integer stretched = cln::ash(odd, distance);
                add(stretched + (k % 2 == 0 ? 1 : -1), two_to(distance), exponent);
                // the same with a denominator that is no power of two
                const Integer denominator = random_integer(distance) * 2 + 1;
                add(odd * denominator + (k % 2 == 0 ? 1 : -1), denominator, exponent);
                add(odd * denominator, denominator, exponent);
            }
        }
    }

    /// Around multiples of half the least denormal, down to what rounds to zero.
    void denormal(int least) {
        for (int halves = 0; halves <= 40; ++halves) {
            for (const int off : {-1, 0, 1}) add(Integer(halves) * two_to(200) + off, two_to(201), least);
        }
        for (int k = 0; k < 300; ++k)
            add(random_integer(between(1, 100)), random_integer(between(1, 100)), least + between(-60, 60));
    }

    /// The largest number is (2^digits - 1) 2^(exponent - digits); from half a step above it on, infinity.
    void overflow(int exponent, int digits) {
        const Integer edge = two_to(digits + 1) - 1;  // in half steps, above the largest number by one
        for (const int off : {-1, 0, 1}) add(edge * two_to(300) + off, two_to(300), exponent - digits - 1);
        for (int half = -3; half <= 3; ++half) add(edge + half, 1, exponent - digits - 1);
        add(1, 1, exponent);
        add(1, 3, exponent + 1);
        add(1, 1, exponent + 1000);
    }

    std::mt19937_64 random_{20260101};
    std::vector<Quotient> out_;
};

struct Nearest {
    std::string as_double;
    std::string as_float;
};

std::vector<Nearest> oracle(const std::vector<Quotient>& quotients) {
    const test::TemporaryFolder folder;
    const std::string in = folder.path("quotients"), out = folder.path("nearest");
    {
        std::ofstream file(in);
        for (const auto& [n, d] : quotients) file << hexadecimal_integer(n) << ' ' << hexadecimal_integer(d) << '\n';
    }
    const std::string command = "PYTHONDONTWRITEBYTECODE=1 python3 '" ALGEST_SOURCE "/tests/exact/rounding_oracle.py' < '" +
                                in + "' > '" + out + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    std::vector<Nearest> nearest;
    std::ifstream file(out);
    for (Nearest one; file >> one.as_double >> one.as_float;) nearest.push_back(one);
    REQUIRE(nearest.size() == quotients.size());
    return nearest;
}

/// What the rounder of tables makes of it.
double rounded_in_words(const Quotient& q, plan::Scalar scalar) {
    exact::WideIntegers words;
    words.words = static_cast<std::size_t>(cln::integer_length(q.first)) / 64 + 1;
    words.data.resize(words.words);
    exact::assign(words, 0, q.first);
    return exact::QuotientRounder(q.second, scalar)(words.at(0), words.words);
}

}  // namespace

TEST_CASE("a quotient is rounded to the nearest double and float, ties to even, denormals included") {
    const std::vector<Quotient> quotients = Quotients().take();
    const std::vector<Nearest> wanted = oracle(quotients);
    int denormal_doubles = 0, denormal_floats = 0, infinite_doubles = 0, infinite_floats = 0;
    for (std::size_t k = 0; k < quotients.size(); ++k) {
        const auto& [n, d] = quotients[k];
        INFO(n << " / " << d);
        const double as_double = exact::nearest_double(n, d);
        const float as_float = exact::nearest_float(n, d);
        CHECK(bits(as_double) == wanted[k].as_double);
        CHECK(bits(as_float) == wanted[k].as_float);
        CHECK(bits(exact::nearest(n, d, plan::Scalar::float64)) == wanted[k].as_double);
        CHECK(bits(exact::nearest(n, d, plan::Scalar::float32)) == bits(static_cast<double>(as_float)));
        CHECK(bits(exact::nearest(Rational(n) / d, plan::Scalar::float64)) == wanted[k].as_double);
        CHECK(bits(static_cast<float>(exact::nearest(Rational(n) / d, plan::Scalar::float32))) == wanted[k].as_float);
        CHECK(bits(rounded_in_words(quotients[k], plan::Scalar::float64)) == wanted[k].as_double);
        CHECK(bits(static_cast<float>(rounded_in_words(quotients[k], plan::Scalar::float32))) == wanted[k].as_float);
        denormal_doubles += std::fpclassify(as_double) == FP_SUBNORMAL ? 1 : 0;
        denormal_floats += std::fpclassify(as_float) == FP_SUBNORMAL ? 1 : 0;
        infinite_doubles += std::isinf(as_double) ? 1 : 0;
        infinite_floats += std::isinf(as_float) ? 1 : 0;
    }
    // The cases are where they are meant to be.
    CHECK(denormal_doubles > 400);
    CHECK(denormal_floats > 400);
    CHECK(infinite_doubles > 10);
    CHECK(infinite_floats > 10);
}

TEST_CASE("the hexadecimal text of a double reads back to the same bits") {
    std::mt19937_64 random(20260102);
    std::vector<double> values = {0.0,
                                  -0.0,
                                  1.0,
                                  -1.0,
                                  0.1,
                                  std::numeric_limits<double>::max(),
                                  std::numeric_limits<double>::min(),
                                  std::numeric_limits<double>::denorm_min(),
                                  -std::numeric_limits<double>::denorm_min(),
                                  std::nextafter(std::numeric_limits<double>::min(), 0.0),
                                  static_cast<double>(0x1p-149f)};
    for (int k = 0; k < 20000; ++k) values.push_back(std::bit_cast<double>(random()));
    for (int k = 0; k < 2000; ++k) values.push_back(std::bit_cast<double>(random() & 0x800FFFFFFFFFFFFFULL));  // denormals
    for (int k = 0; k < 2000; ++k) values.push_back(std::ldexp(1.0, static_cast<int>(random() % 2098) - 1074));
    int checked = 0;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        const std::string text = exact::hexadecimal(value);
        INFO(text);
        char* end = nullptr;
        CHECK(bits(std::strtod(text.c_str(), &end)) == bits(value));
        CHECK(*end == '\0');
        if (std::isnormal(value) || value == 0) {
            char printed[40];
            std::snprintf(printed, sizeof printed, "%a",
                          value);  // of the C library: the same form where the number is not denormal
            CHECK(text == printed);
        } else {
            CHECK(text.find("0x1") <= 1);
        }
        ++checked;
    }
    CHECK(checked > 20000);
}

TEST_CASE("a double stands for the decimal that a person wrote") {
    std::mt19937_64 random(20260103);
    for (int k = 0; k < 5000; ++k) {
        // Up to 15 digits survive a double unchanged, so the shortest decimal of the double is the one that was written.
        const int digits = 1 + static_cast<int>(random() % 15);
        std::string text = random() % 2 == 0 ? "-" : "";
        text += static_cast<char>('1' + random() % 9);
        text += '.';
        for (int d = 1; d < digits; ++d) text += static_cast<char>('0' + random() % 10);
        text += "e" + std::to_string(static_cast<int>(random() % 600) - 300);
        INFO(text);
        CHECK(exact::text(exact::from_double(std::strtod(text.c_str(), nullptr))) ==
              exact::text(exact::parse(text).value()));
    }
    for (int k = 0; k < 5000; ++k) {
        const double value = std::bit_cast<double>(random());
        if (std::isfinite(value))
            CHECK(bits(exact::nearest(exact::from_double(value), plan::Scalar::float64)) == bits(value));
    }
    CHECK(exact::text(exact::from_double(0.1)) == "1/10");
    CHECK(exact::text(exact::from_double(-2.5e-3)) == "-1/400");
    CHECK(exact::text(exact::from_double(-0.0)) == "0");
    for (const double value : {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
                               std::numeric_limits<double>::denorm_min()}) {
        CHECK(bits(exact::nearest(exact::from_double(value), plan::Scalar::float64)) == bits(value));
    }
}

TEST_CASE("decimals and fractions are read exactly") {
    std::mt19937_64 random(20260104);
    const auto digits = [&](std::size_t count) {
        std::string out;
        for (std::size_t k = 0; k < count; ++k) out += static_cast<char>('0' + random() % 10);
        return out;
    };
    /// The value of whole.part e exponent, digit by digit.
    const auto value_of = [](const std::string& whole, const std::string& part, int exponent) {
        Integer out = 0;
        for (const char c : whole + part) out = 10 * out + (c - '0');
        Rational value = out;
        for (int e = exponent - static_cast<int>(part.size()); e != 0; e += e > 0 ? -1 : 1)
            value = e > 0 ? value * 10 : value / 10;
        return value;
    };
    for (int k = 0; k < 2000; ++k) {
        const std::string whole = digits(1 + random() % 20), part = digits(random() % 20);
        const int exponent = static_cast<int>(random() % 701) - 350;   // with 40 digits before it within the 400 that a number may have
        const Rational value = value_of(whole, part, exponent);
        const std::string point = part.empty() && random() % 2 == 0 ? "" : ".";
        const std::string text = whole + point + part + (random() % 2 == 0 ? "e" : "E") +
                                 (exponent > 0 && random() % 2 == 0 ? "+" : "") + std::to_string(exponent);
        INFO(text);
        CHECK(exact::text(exact::parse(text).value()) == exact::text(value));
        CHECK(exact::text(exact::parse("-" + text).value()) == exact::text(-value));
        CHECK(exact::text(exact::parse("+" + text).value()) == exact::text(value));
        CHECK(exact::parse(exact::text(value)).value() == value);
        const std::string below = "1" + digits(random() % 10);
        CHECK(exact::parse(whole + "/" + below).value() == value_of(whole, "", 0) / value_of(below, "", 0));
    }
    // Beyond, what is read is printed as something that reads back; the rest is refused.
    for (const std::string text : {"1e399", "1e400", "1.5e-399", "1.5e-400", "1e-1000000"}) {
        INFO(text);
        const auto value = exact::parse(text);
        CHECK(value.has_value() == (text == "1e399" || text == "1.5e-399"));
        if (value) CHECK(exact::parse(exact::text(*value)) == value);
    }
    const auto read = [](const char* text) {
        const auto value = exact::parse(text);
        return value ? exact::text(*value) : "not a number";
    };
    CHECK(read(".5") == "1/2");
    CHECK(read("5.") == "5");
    CHECK(read("-.5e1") == "-5");
    CHECK(read("1/3") == "1/3");
    CHECK(read(" 1 / 3 ") == "1/3");
    CHECK(read("-2/6") == "-1/3");
    CHECK(read("0.1/0.3") == "1/3");
    CHECK(read("0") == "0");
    CHECK(read("-0") == "0");
    for (const char* text : {"",
                             " ",
                             ".",
                             "-",
                             "+",
                             "e5",
                             ".e5",
                             "1e",
                             "1e+",
                             "1e5.5",
                             "--1",
                             "+-1",
                             "1-",
                             "0x10",
                             "1e401",
                             "1e-401",
                             "1 2",
                             "nan",
                             "inf",
                             "1/0",
                             "1/0.0",
                             "1/",
                             "/2",
                             "/",
                             "1/2/3",
                             "1//2",
                             "1,5",
                             "1e5 ",
                             "1e99999999999999999999"}) {
        INFO("'" << text << "'");
        CHECK(read(text) == std::string("not a number"));
    }
    CHECK(read("1e+-5") == std::string("not a number"));
}

}  // namespace algest
