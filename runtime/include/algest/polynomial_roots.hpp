// SPDX-License-Identifier: MIT-0
// All real roots of a polynomial with a fixed number of iterations. Between two neighbouring roots of its derivative a polynomial has at most one
// root: bisection finds it, from the derivative of order degree - 1 up to the polynomial itself. [-1, 1] serves every root: those outside are
// the reciprocals of the roots of the reversed polynomial.
#pragma once
#include <cmath>
#include <limits>

namespace algest {

/// Halvings of an interval of length 2 at most: one digit each, and some for small roots. Newton's steps are left to who knows the equations.
template <class S>
constexpr int root_halvings() noexcept {
    return std::numeric_limits<S>::digits + 11;
}

/// c[0] + c[1] x + ... by Horner's rule. Cost: degree multiply-adds.
template <class S>
inline S polynomial_value(const S* c, int degree, S x) noexcept {
    S value = c[degree];
    for (int k = degree - 1; k >= 0; --k) value = value * x + c[k];
    return value;
}

/// Scalars of scratch that real_roots needs.
constexpr int real_roots_scratch(int degree) noexcept { return 5 * (degree + 1); }
/// Places for roots that real_roots fills, real or not.
constexpr int root_places(int degree) noexcept { return 2 * degree; }

namespace detail {

/// What rounding may leave of a value that is zero: a part of the sum of the sizes of its terms.
template <class S>
inline S value_of_sizes(const S* c, int degree, S x) noexcept {
    const S size = std::abs(x);
    S value = std::abs(c[degree]);
    for (int k = degree - 1; k >= 0; --k) value = value * size + std::abs(c[k]);
    return value;
}

/// In [low, high], where p is monotone: its root, or the end with the smaller value. True for a sign change.
template <class S>
inline bool bisect(const S* p, int degree, S low, S high, S& root) noexcept {
    const S at_low = polynomial_value(p, degree, low);
    const S at_high = polynomial_value(p, degree, high);
    const bool rises = at_low < S(0);
    const bool changes = rises != (at_high < S(0));
    const S nearer = std::abs(at_low) <= std::abs(at_high) ? low : high;
    for (int k = 0; k < root_halvings<S>(); ++k) {
        const S middle = S(0.5) * (low + high);
        const bool before = (polynomial_value(p, degree, middle) < S(0)) == rises;
        low = before ? middle : low;
        high = before ? high : middle;
    }
    root = changes ? S(0.5) * (low + high) : nearer;
    return changes;
}

/// degree places of the roots in [-1, 1], ascending; real[k] 0 where place k holds none. A place where p touches zero to rounding counts.
/// scratch: 3 (degree + 1) scalars.
template <class S>
inline void roots_in_unit_interval(const S* c, int degree, S* scratch, S* roots, S* real) noexcept {
    S* const p = scratch;
    S* const before = p + degree + 1;   // roots of the derivative of p
    S* const found = before + degree + 1;
    for (int d = 1; d <= degree; ++d) {
        const int order = degree - d;   // p is the derivative of this order over order!: its coefficients are times binomials
        for (int k = 0; k <= d; ++k) {
            S binomial = S(1);
            for (int j = 1; j <= order; ++j) binomial = binomial * S(k + j) / S(j);
            p[k] = c[k + order] * binomial;
        }
        for (int k = 0; k < d; ++k) {
            const S low = k == 0 ? S(-1) : before[k - 1];
            const S high = k == d - 1 ? S(1) : before[k];
            const bool changes = bisect(p, d, low, high, found[k]);
            const S rest = S(16 * d) * std::numeric_limits<S>::epsilon() * value_of_sizes(p, d, found[k]);
            real[k] = changes || std::abs(polynomial_value(p, d, found[k])) <= rest ? S(1) : S(0);
        }
        for (int k = 0; k < d; ++k) before[k] = found[k];
    }
    for (int k = 0; k < degree; ++k) roots[k] = before[k];
}

}  // namespace detail

/// Places of roots of c[0] + ... + c[degree] x^degree: first those in [-1, 1], then those outside, each `degree` places; real[k] is 1 where place k
/// holds a real root, else 0. A multiple root may stand at several places. An absolute error of 2^-(digits+10) before rounding of the coefficients:
/// simple roots are as accurate as their condition allows. Coefficients that are not finite, or all zero, give no root.
/// scratch: real_roots_scratch. roots, real: root_places. Cost: about degree^3 (digits + 11) / 3 multiply-adds, the same for every polynomial.
template <class S>
inline void real_roots(const S* c, int degree, S* scratch, S* roots, S* real) noexcept {
    S* const forward = scratch;
    S* const reversed = forward + degree + 1;
    S* const work = reversed + degree + 1;
    S size = S(0);
    for (int k = 0; k <= degree; ++k) size = std::abs(c[k]) <= size ? size : S(std::abs(c[k]));   // a NaN is not <=: it stays
    const bool usable = size > S(0) && std::isfinite(size);
    for (int k = 0; k <= degree; ++k) {
        forward[k] = usable ? c[k] / size : S(0);
        reversed[degree - k] = forward[k];
    }
    detail::roots_in_unit_interval(forward, degree, work, roots, real);
    detail::roots_in_unit_interval(reversed, degree, work, roots + degree, real + degree);
    for (int k = degree; k < 2 * degree; ++k) {
        const S reciprocal = roots[k];
        const bool outside = real[k] > S(0) && std::abs(reciprocal) > std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon();
        real[k] = outside ? S(1) : S(0);
        roots[k] = outside ? S(1) / reciprocal : S(0);
    }
    for (int k = 0; k < 2 * degree && !usable; ++k) real[k] = S(0);
}

}  // namespace algest
