// SPDX-License-Identifier: MIT-0
// Upper triangular systems and their condition: the last step of every solver.
#pragma once
#include <cmath>
#include <limits>

namespace algest {

/// How a solve ended. `condition` is that of the scaled matrix that was solved, infinity when its rank test failed.
template <class S>
struct Solved {
    bool regular;
    S condition;
};

/// Smallest scaled pivot, relative to the largest, that a rank test of n columns accepts.
template <class S>
constexpr S smallest_pivot(int n) noexcept {
    return S(n) * std::numeric_limits<S>::epsilon();
}

/// x = U^-1 b. upper: row-major, `width` >= n + 1 entries a row, b in column n; x: n entries, may not overlap.
/// Cost: n^2 operations. The diagonal must not be zero.
template <class S>
inline void back_substitute(const S* upper, int n, int width, S* x) noexcept {
    for (int i = n - 1; i >= 0; --i) {
        S sum = upper[i * width + n];
        for (int k = i + 1; k < n; ++k) sum -= upper[i * width + k] * x[k];
        x[i] = sum / upper[i * width + i];
    }
}

/// Multiply-adds and divisions of condition_of_upper.
constexpr long condition_of_upper_cost(int unknowns) noexcept {
    const long n = unknowns;
    return (n - 1) * n * (n + 1) / 6 + n * (n + 1) / 2 + n * (n + 1) + 1;
}

/// |U|_F |U^-1|_F, an upper bound of the spectral condition number, at most n times too large.
/// scratch: n scalars. Cost: condition_of_upper_cost. The diagonal must not be zero.
template <class S>
inline S condition_of_upper(const S* upper, int n, int width, S* scratch) noexcept {
    S norm = S(0);
    S inverse_norm = S(0);
    for (int j = 0; j < n; ++j) {
        scratch[j] = S(1) / upper[j * width + j];
        inverse_norm += scratch[j] * scratch[j];
        for (int i = j; i >= 0; --i) norm += upper[i * width + j] * upper[i * width + j];
        for (int i = j - 1; i >= 0; --i) {
            S sum = S(0);
            for (int k = i + 1; k <= j; ++k) sum += upper[i * width + k] * scratch[k];
            scratch[i] = -sum / upper[i * width + i];
            inverse_norm += scratch[i] * scratch[i];
        }
    }
    return std::sqrt(norm) * std::sqrt(inverse_norm);
}

}  // namespace algest
