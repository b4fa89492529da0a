// SPDX-License-Identifier: GPL-3.0-or-later
// Exact values of an integer polynomial at 0, 1, 2, ... and their rounded quotients, in machine words: CLN allocates at every
// operation, and a table has thousands.
#pragma once
#include <cstdint>
#include <vector>

#include "generator/exact.hpp"

namespace algest::exact {

/// Integers of `words` 64-bit words each, two's complement, lowest word first, one after the other.
struct WideIntegers {
    std::size_t words = 0;
    std::vector<std::uint64_t> data;

    const std::uint64_t* at(std::size_t k) const { return data.data() + k * words; }
    std::uint64_t* at(std::size_t k) { return data.data() + k * words; }
};

/// The sequence with the given forward differences at 0 (value, first difference, ...): `count` values, exact as long as each
/// value has at most `bits` bits; the sums on the way may overflow, since they are taken modulo a power of two.
/// Cost: count * differences * words additions.
WideIntegers sequence(const std::vector<Integer>& differences, std::size_t count, std::size_t bits);

/// Sets one value; it must fit.
void assign(WideIntegers& values, std::size_t k, const Integer& value);

/// Multiplies one value by a small positive factor.
void multiply(WideIntegers& values, std::size_t k, std::uint64_t factor);

Integer to_integer(const std::uint64_t* words, std::size_t count);

/// Rounds many numerators over one denominator to the nearest number of a scalar, ties to even, denormals included.
class QuotientRounder {
public:
    /// denominator > 0
    QuotientRounder(Integer denominator, plan::Scalar scalar);
    double operator()(const std::uint64_t* words, std::size_t count) const;

private:
    /// The nearest double where 128 bits of numerator and reciprocal decide it; false where they do not.
    bool quick(const std::uint64_t* words, std::size_t count, bool negative, double& out) const;

    Integer denominator_;
    plan::Scalar scalar_;
    unsigned __int128 reciprocal_ = 0;   ///< floor(2^reciprocal_exponent_ / denominator), its highest bit set
    long reciprocal_exponent_ = 0;
};

}  // namespace algest::exact
