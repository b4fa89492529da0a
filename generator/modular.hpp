// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers modulo a prime, and linear algebra over them: generic ranks without the growth of fractions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "generator/exact.hpp"

namespace algest::modular {

/// 2^31 - 1. What holds at a random point modulo it and is false over the fractions has a chance of about degree / 2e9 (Schwartz, Zippel).
constexpr std::uint64_t prime = 2147483647;

class Number {
public:
    Number() = default;
    Number(std::int64_t value) : value_(static_cast<std::uint32_t>(((value % static_cast<std::int64_t>(prime)) + static_cast<std::int64_t>(prime)) % static_cast<std::int64_t>(prime))) {}

    std::uint32_t value() const { return value_; }
    bool is_zero() const { return value_ == 0; }

    friend Number operator+(Number a, Number b) { return reduced(std::uint64_t{a.value_} + b.value_); }
    friend Number operator-(Number a, Number b) { return reduced(std::uint64_t{a.value_} + prime - b.value_); }
    friend Number operator*(Number a, Number b) { return reduced(std::uint64_t{a.value_} * b.value_); }
    /// b != 0
    friend Number operator/(Number a, Number b) { return a * b.inverse(); }
    friend bool operator==(Number a, Number b) { return a.value_ == b.value_; }

    Number power(std::uint64_t exponent) const {
        Number out = 1;
        Number square = *this;
        for (; exponent > 0; exponent >>= 1U) {
            if ((exponent & 1U) != 0) out = out * square;
            square = square * square;
        }
        return out;
    }
    /// Fermat; of a number that is not zero.
    Number inverse() const { return power(prime - 2); }

private:
    static Number reduced(std::uint64_t value) {
        Number out;
        out.value_ = static_cast<std::uint32_t>(value % prime);
        return out;
    }
    std::uint32_t value_ = 0;
};

/// Of an integer or a fraction whose denominator the prime does not divide.
inline Number from(const exact::Rational& value) {
    const auto part = [](const exact::Integer& i) { return Number(cln::cl_I_to_long(cln::mod(i, exact::Integer(static_cast<unsigned long>(prime))))); };
    return part(cln::numerator(value)) / part(cln::denominator(value));
}

/// Half of the numbers have a square root.
inline bool has_root(Number n) { return !n.is_zero() && n.power((prime - 1) / 2) == Number(1); }
/// Of a number that has one: that of the two which has a root itself.
inline Number root_of(Number n) { return n.power((prime + 1) / 4); }   // the prime is 3 modulo 4

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;   ///< splitmix64's step: 2^64 over the golden ratio
/// splitmix64's mixing.
constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}
/// Not zero.
inline Number number_of(std::uint64_t bits) { return Number(static_cast<std::int64_t>(bits % (prime - 1)) + 1); }

/// A number that follows from what it is for, whatever was drawn before; not zero. The same on every machine and run.
inline Number drawn(std::initializer_list<std::uint64_t> meaning) {
    std::uint64_t state = 0;
    for (const std::uint64_t part : meaning) state = mixed(state + golden + part);
    return number_of(mixed(state + golden));
}

/// A sequence for who asks in an order that is always the same. The same numbers on every machine and run.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : state_(seed) {}
    /// Not zero.
    Number next() {
        state_ += golden;
        return number_of(mixed(state_));
    }

private:
    std::uint64_t state_;
};

using Vector = std::vector<Number>;

/// The space that rows span, in echelon form. Cost: one row operation per row that is already there.
class RowSpace {
public:
    std::size_t rank() const { return rows_.size(); }

    /// What is left of a row after all of the space is taken off it.
    Vector rest(Vector row) const {
        for (const auto& [pivot, known] : rows_) {
            const Number factor = row[pivot];
            if (factor.is_zero()) continue;
            for (std::size_t k = pivot; k < row.size(); ++k) row[k] = row[k] - factor * known[k];
        }
        return row;
    }

    /// False: the column is zero in all of the space.
    bool touches(std::size_t column) const {
        for (const auto& [pivot, row] : rows_) if (!row[column].is_zero()) return true;
        return false;
    }

    bool contains(const Vector& row) const { return pivot_of(rest(row)) == row.size(); }

    /// True if the row adds a dimension.
    bool add(const Vector& row) {
        Vector left = rest(row);
        const std::size_t pivot = pivot_of(left);
        if (pivot == left.size()) return false;
        const Number scale = left[pivot].inverse();
        for (Number& x : left) x = x * scale;
        std::size_t place = 0;
        while (place < rows_.size() && rows_[place].first < pivot) ++place;
        rows_.insert(rows_.begin() + static_cast<std::ptrdiff_t>(place), {pivot, std::move(left)});
        return true;
    }

private:
    static std::size_t pivot_of(const Vector& row) {
        std::size_t k = 0;
        while (k < row.size() && row[k].is_zero()) ++k;
        return k;
    }
    std::vector<std::pair<std::size_t, Vector>> rows_;   // by pivot
};

}  // namespace algest::modular
