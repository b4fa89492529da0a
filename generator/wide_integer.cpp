// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/wide_integer.hpp"

#include <bit>
#include <cmath>

namespace algest::exact {

namespace {

using Word = std::uint64_t;
using Wide = unsigned __int128;

/// Longest numerator that the quick rounding takes.
constexpr std::size_t most_words = 32;

void store(const Integer& value, Word* words, std::size_t count) {
    Integer rest = value;   // CLN's logical operations see two's complement
    for (std::size_t k = 0; k < count; ++k) {
        words[k] = cln::cl_I_to_ulong(cln::ldb(rest, cln::cl_byte(64, 0)));
        rest = cln::ash(rest, -64);
    }
}

void add_to(Word* a, const Word* b, std::size_t words) {
    Word carry = 0;
    for (std::size_t k = 0; k < words; ++k) {
        const Wide sum = static_cast<Wide>(a[k]) + b[k] + carry;
        a[k] = static_cast<Word>(sum);
        carry = static_cast<Word>(sum >> 64);
    }
}

bool is_negative(const Word* words, std::size_t count) { return (words[count - 1] >> 63) != 0; }

int bit_length(Wide x) {
    const Word high = static_cast<Word>(x >> 64);
    return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(static_cast<Word>(x));
}

/// The upper 128 bits of a product of two 128-bit numbers.
Wide high_product(Wide a, Wide b) {
    const Wide a1 = a >> 64, a0 = static_cast<Word>(a);
    const Wide b1 = b >> 64, b0 = static_cast<Word>(b);
    const Wide middle = a1 * b0 + (a0 * b0 >> 64);
    const Wide middle2 = a0 * b1 + static_cast<Word>(middle);
    return a1 * b1 + (middle >> 64) + (middle2 >> 64);
}

}  // namespace

WideIntegers sequence(const std::vector<Integer>& differences, std::size_t count, std::size_t bits) {
    WideIntegers out;
    out.words = (bits + 1) / 64 + 1;
    out.data.resize(out.words * count);
    std::vector<Word> running(out.words * differences.size());
    for (std::size_t k = 0; k < differences.size(); ++k) store(differences[k], running.data() + k * out.words, out.words);
    for (std::size_t m = 0; m < count; ++m) {
        for (std::size_t w = 0; w < out.words; ++w) out.at(m)[w] = running[w];
        for (std::size_t k = 0; k + 1 < differences.size(); ++k) {
            add_to(running.data() + k * out.words, running.data() + (k + 1) * out.words, out.words);
        }
    }
    return out;
}

void assign(WideIntegers& values, std::size_t k, const Integer& value) { store(value, values.at(k), values.words); }

void multiply(WideIntegers& values, std::size_t k, std::uint64_t factor) {
    Word* words = values.at(k);
    Word carry = 0;
    for (std::size_t w = 0; w < values.words; ++w) {
        const Wide product = static_cast<Wide>(words[w]) * factor + carry;
        words[w] = static_cast<Word>(product);
        carry = static_cast<Word>(product >> 64);
    }
}

Integer to_integer(const std::uint64_t* words, std::size_t count) {
    Integer out = static_cast<long>(static_cast<std::int64_t>(words[count - 1]));
    for (std::size_t k = count - 1; k-- > 0;) out = cln::ash(out, 64) + Integer(static_cast<unsigned long>(words[k]));
    return out;
}

QuotientRounder::QuotientRounder(Integer denominator, plan::Scalar scalar) : denominator_(std::move(denominator)), scalar_(scalar) {
    // 2^(length-1) <= d < 2^length, so 2^(127+length) / d has 128 bits, or 129 for a power of two: then one bit less.
    const long length = static_cast<long>(cln::integer_length(denominator_));
    const bool power_of_two = cln::logcount(denominator_) == 1;
    reciprocal_exponent_ = 127 + length - (power_of_two ? 1 : 0);
    const Integer reciprocal = cln::floor1(cln::ash(Integer(1), reciprocal_exponent_), denominator_);
    Word words[2];
    store(reciprocal, words, 2);
    reciprocal_ = (static_cast<Wide>(words[1]) << 64) | words[0];
}

double QuotientRounder::operator()(const std::uint64_t* words, std::size_t count) const {
    bool zero = true;
    for (std::size_t k = 0; k < count; ++k) zero = zero && words[k] == 0;
    if (zero) return 0.0;
    const bool negative = is_negative(words, count);
    double out = 0;
    if (quick(words, count, negative, out)) return out;
    return nearest(to_integer(words, count), denominator_, scalar_);
}

bool QuotientRounder::quick(const std::uint64_t* words, std::size_t count, bool negative, double& out) const {
    Word magnitude[most_words];
    if (count > most_words) return false;
    Word carry = 1;   // two's complement: complement and add one
    for (std::size_t k = 0; k < count; ++k) {
        magnitude[k] = negative ? ~words[k] + carry : words[k];
        carry = carry != 0 && magnitude[k] == 0 ? 1 : 0;
    }
    std::size_t top = count;
    while (magnitude[top - 1] == 0) --top;   // the value is not zero
    const auto word = [&](std::size_t below) { return below < top ? magnitude[top - 1 - below] : 0; };
    const int shift = std::countl_zero(word(0));
    const Wide first = (static_cast<Wide>(word(0)) << 64) | word(1);
    const Wide numerator = shift == 0 ? first : (first << shift) | (word(2) >> (64 - shift));
    const long numerator_exponent = 64 * (static_cast<long>(top) - 2) - shift;

    // n <= N/2^e < n+1 and r <= R < r+1: the quotient lies in [p, p+4) times 2^128, p the upper half of n r.
    const Wide product = high_product(numerator, reciprocal_);
    const int digits = scalar_ == plan::Scalar::float64 ? 53 : 24;
    const int drop = bit_length(product) - digits;
    const Wide tail = product & ((static_cast<Wide>(1) << drop) - 1);
    const Wide half = static_cast<Wide>(1) << (drop - 1);
    constexpr unsigned margin = 4;
    Word mantissa = static_cast<Word>(product >> drop);
    if (tail > half && tail < 2 * half - margin) ++mantissa;
    else if (tail >= half - margin) return false;
    const long exponent = numerator_exponent + 128 - reciprocal_exponent_ + drop;
    const long value_exponent = exponent + digits;
    const bool single = scalar_ == plan::Scalar::float32;
    if (value_exponent < (single ? -120 : -1015) || value_exponent > (single ? 120 : 1015)) return false;   // near the ends: exactly
    out = std::ldexp(static_cast<double>(mantissa), static_cast<int>(exponent));
    if (negative) out = -out;
    return true;
}

}  // namespace algest::exact
