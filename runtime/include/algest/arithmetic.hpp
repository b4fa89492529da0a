// SPDX-License-Identifier: MIT-0
// The functions of a model's formulas, as replay and generated code both call them.
#pragma once
#include <cmath>

namespace algest {

/// -1, 0 or 1; NaN for NaN.
template <class S>
inline S sgn(S x) noexcept {
    return x > S(0) ? S(1) : (x < S(0) ? S(-1) : x * S(0));
}

/// The smaller of two; NaN if either is.
template <class S>
inline S smaller(S a, S b) noexcept {
    return a < b ? a : (b <= a ? b : a + b);
}

/// The larger of two; NaN if either is.
template <class S>
inline S larger(S a, S b) noexcept {
    return a > b ? a : (b >= a ? b : a + b);
}

/// True when every one of count values is finite.
template <class S>
inline bool all_finite(const S* values, int count) noexcept {
    bool finite = true;
    for (int i = 0; i < count; ++i) finite = finite && std::isfinite(values[i]);
    return finite;
}

/// True when low <= x <= high; false for NaN.
template <class S>
inline bool within(S x, S low, S high) noexcept {
    return x >= low && x <= high;
}

}  // namespace algest
