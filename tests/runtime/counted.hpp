// SPDX-License-Identifier: GPL-3.0-or-later
// A scalar that counts its products and quotients. To be included before the runtime, whose templates name functions of std.
#pragma once
#include <cmath>
#include <limits>
#include <type_traits>

namespace algest::test {

/// A double that counts its products and quotients.
struct Counted {
    double v;
    static long operations;
    Counted() = default;
    template <class N, std::enable_if_t<std::is_arithmetic_v<N> || std::is_enum_v<N>, int> = 0>
    constexpr Counted(N x) : v(static_cast<double>(x)) {}
    explicit operator int() const { return static_cast<int>(v); }   // a column that a solver keeps among its scalars
    Counted& operator+=(Counted b) { return *this = Counted(v + b.v); }
    Counted& operator-=(Counted b) { return *this = Counted(v - b.v); }
    Counted& operator*=(Counted b) { return *this = *this * b; }
    Counted& operator/=(Counted b) { return *this = *this / b; }
    friend Counted operator+(Counted a, Counted b) { return a.v + b.v; }
    friend Counted operator-(Counted a, Counted b) { return a.v - b.v; }
    friend Counted operator-(Counted a) { return -a.v; }
    friend Counted operator*(Counted a, Counted b) { return ++operations, Counted(a.v * b.v); }
    friend Counted operator/(Counted a, Counted b) { return ++operations, Counted(a.v / b.v); }
    friend bool operator<(Counted a, Counted b) { return a.v < b.v; }
    friend bool operator>(Counted a, Counted b) { return a.v > b.v; }
    friend bool operator<=(Counted a, Counted b) { return a.v <= b.v; }
    friend bool operator>=(Counted a, Counted b) { return a.v >= b.v; }
    friend bool operator==(Counted a, Counted b) { return a.v == b.v; }
    friend bool operator!=(Counted a, Counted b) { return a.v != b.v; }
};
inline long Counted::operations = 0;

}  // namespace algest::test

namespace std {   // where the runtime looks for them

inline algest::test::Counted abs(algest::test::Counted x) { return std::fabs(x.v); }
inline algest::test::Counted sqrt(algest::test::Counted x) { return std::sqrt(x.v); }
inline bool isfinite(algest::test::Counted x) { return std::isfinite(x.v); }
template <>
struct numeric_limits<algest::test::Counted> {
    static constexpr int digits = numeric_limits<double>::digits;
    static algest::test::Counted epsilon() { return numeric_limits<double>::epsilon(); }
    static algest::test::Counted min() { return numeric_limits<double>::min(); }
    static algest::test::Counted infinity() { return numeric_limits<double>::infinity(); }
};

}  // namespace std
