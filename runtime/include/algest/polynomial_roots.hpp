// SPDX-License-Identifier: MIT-0
// All real roots of a polynomial with a fixed number of iterations. Between two neighbouring roots of its derivative a polynomial has at most one
// root: bisection finds it, from the derivative of order degree - 1 up to the polynomial itself. [-1, 1] serves every root: those outside are
// the reciprocals of the roots of the reversed polynomial.
#pragma once
#include <cmath>
#include <limits>

namespace algest {

/// Halvings of an interval of length 2 at most: one digit each, one for the length, and ten more, so that a root of size 2^-10 has all its digits,
/// too. Newton's steps, which would bring the rest, are left to who knows the equations.
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
constexpr int real_roots_scratch(int degree) noexcept { return 5 * (degree + 1) + 4 * degree; }
/// Places for roots that real_roots fills, real or not: a polynomial has no more roots than its degree.
constexpr int root_places(int degree) noexcept { return degree; }

namespace detail {

/// How sure a root is.
enum : int { no_root = 0, touching = 1, crossing = 2 };

template <class S>
inline bool close(S a, S b, S within) noexcept {
    return std::abs(a - b) <= within * (S(1) + std::abs(b));
}

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
    const S middle = S(0.5) * (low + high);
    root = changes ? middle : nearer;
    return changes;
}

/// Multiply-adds and divisions of roots_in_unit_interval.
template <class S>
constexpr long roots_in_unit_interval_cost(int degree) noexcept {
    constexpr long halvings = root_halvings<S>();
    long out = 0;
    for (long d = 1; d <= degree; ++d) out += (d + 1) * (2 * (degree - d) + 1) + d * ((halvings + 4) * d + halvings + 3);
    return out;
}

/// degree places of the roots in [-1, 1], ascending. kinds[k]: crossing where the sign changes at place k, touching where p is zero there to rounding,
/// else no_root. scratch: 3 (degree + 1) scalars.
template <class S>
inline void roots_in_unit_interval(const S* c, int degree, S* scratch, S* roots, S* kinds) noexcept {
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
            // Horner's d products and d sums leave d epsilon of the sizes at most; the coefficients, which are derivatives, several times that.
            const S rest = S(16 * d) * std::numeric_limits<S>::epsilon() * value_of_sizes(p, d, found[k]);
            const bool touches = std::abs(polynomial_value(p, d, found[k])) <= rest;
            kinds[k] = changes ? S(crossing) : touches ? S(touching) : S(no_root);
        }
        for (int k = 0; k < d; ++k) before[k] = found[k];
    }
    for (int k = 0; k < degree; ++k) roots[k] = before[k];
}

/// Gathers what was found in 2 degree places in the first of `degree`: crossings first, then what only touches, unless it stands beside one of them.
template <class S>
inline void gather_roots(const S* found, const S* kinds, int degree, S* roots, S* real) noexcept {
    const S same = std::sqrt(std::numeric_limits<S>::epsilon());   // how far rounding moves a double root
    for (int k = 0; k < degree; ++k) roots[k] = real[k] = S(0);
    int count = 0;
    for (int pass = 0; pass < 2; ++pass) {
        const int kind = pass == 0 ? crossing : touching;
        for (int k = 0; k < 2 * degree; ++k) {
            bool there = false;
            for (int j = 0; j < degree; ++j) {
                const bool beside = close(found[k], roots[j], same);
                there = there || (beside && kind == touching && j < count);
            }
            if (!(kinds[k] == S(kind)) || there || count == degree) continue;
            roots[count] = found[k];
            real[count++] = S(1);
        }
    }
}

}  // namespace detail

/// Multiply-adds and divisions of real_roots.
template <class S>
constexpr long real_roots_cost(int degree) noexcept {
    return 2 * detail::roots_in_unit_interval_cost<S>(degree) + (degree + 1L) + 1 + degree + 4L * degree * degree;
}

/// Places of roots of c[0] + ... + c[degree] x^degree; real[k] is 1 where place k holds a real root, else 0, and roots[k] is 0 there.
/// A multiple root may stand at several places. An absolute error of 2^-(digits+10) before rounding of the coefficients:
/// simple roots are as accurate as their condition allows. Coefficients that are not finite, or all zero, give no root.
/// scratch: real_roots_scratch. roots, real: root_places. Cost: real_roots_cost, about 2/3 degree^3 (digits + 11), the same for every polynomial.
template <class S>
inline void real_roots(const S* c, int degree, S* scratch, S* roots, S* real) noexcept {
    S* const forward = scratch;
    S* const reversed = forward + degree + 1;
    S* const work = reversed + degree + 1;
    S* const found = work + 3 * (degree + 1);
    S* const kinds = found + 2 * degree;
    S size = S(0);
    for (int k = 0; k <= degree; ++k) size = std::abs(c[k]) <= size ? size : S(std::abs(c[k]));   // a NaN is not <=: it stays
    const bool usable = size > S(0) && std::isfinite(size);
    for (int k = 0; k <= degree; ++k) {
        const S part = c[k] / size;
        forward[k] = usable ? part : S(0);
        reversed[degree - k] = forward[k];
    }
    detail::roots_in_unit_interval(forward, degree, work, found, kinds);
    detail::roots_in_unit_interval(reversed, degree, work, found + degree, kinds + degree);
    const S smallest = std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon();   // whose reciprocal is finite
    for (int k = degree; k < 2 * degree; ++k) {
        const bool outside = std::abs(found[k]) > smallest;
        if (!outside) kinds[k] = S(detail::no_root);
        found[k] = S(1) / (outside ? found[k] : S(1));
    }
    for (int k = 0; k < 2 * degree && !usable; ++k) kinds[k] = S(detail::no_root);
    detail::gather_roots(found, kinds, degree, roots, real);
}

}  // namespace algest
