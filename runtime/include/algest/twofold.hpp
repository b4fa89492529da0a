// SPDX-License-Identifier: MIT-0
// What window moments are summed in: a scalar, or the unevaluated sum of two (Ogita, Rump, Oishi 2005, Dot2), which holds about twice
// the digits of a single-precision unit.
#pragma once
#include <cmath>

namespace algest {

/// high + low, unevaluated. Trivially copyable.
template <class S>
struct Twofold {
    S high;
    S low;
};

/// sum += a b, rounded as the type of sum does. Cost: 2 operations.
template <class S>
inline void add_product(double& sum, double a, S b) noexcept {
    sum += a * static_cast<double>(b);
}

/// sum += a b; the rounding errors of product and sum go to the low part. Cost: 10 operations, two of them fused multiply-adds (in
/// hardware where the unit has them: their results are the same everywhere).
template <class S>
inline void add_product(Twofold<S>& sum, Twofold<S> a, S b) noexcept {
    const S product = a.high * b;
    const S product_error = std::fma(a.low, b, std::fma(a.high, b, -product));
    const S high = sum.high + product;
    const S added = high - sum.high;
    const S sum_error = (sum.high - (high - added)) + (product - added);
    sum.high = high;
    sum.low += sum_error + product_error;
}
/// The same for a factor of two parts. Cost: 11 operations.
template <class S>
inline void add_product(Twofold<S>& sum, Twofold<S> a, Twofold<S> b) noexcept {
    add_product(sum, a, b.high);
    sum.low = std::fma(a.high, b.low, sum.low);
}

/// a b, as the type of a rounds it.
template <class S>
inline double times(double a, S b) noexcept {
    return a * static_cast<double>(b);
}
template <class S>
inline Twofold<S> times(Twofold<S> a, S b) noexcept {
    const S product = a.high * b;
    return {product, std::fma(a.low, b, std::fma(a.high, b, -product))};
}

/// The nearest scalar, or next to it.
template <class S>
inline S rounded(double x) noexcept {
    return static_cast<S>(x);
}
template <class S>
inline S rounded(Twofold<S> x) noexcept {
    return x.high + x.low;
}

/// An exact scalar as accumulators take it.
template <class S>
inline void assign(double& to, S x) noexcept {
    to = static_cast<double>(x);
}
template <class S>
inline void assign(Twofold<S>& to, S x) noexcept {
    to.high = x;
    to.low = S(0);
}

}  // namespace algest
