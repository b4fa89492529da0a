// SPDX-License-Identifier: MIT-0
// Whether rows see every combination of the unknowns by more than noise does, of which the Gram matrix of its changes in the regressors is known. Noise
// has full rank: without this test it would pass for the second speed or current that data lack.
#pragma once
#include <cmath>

#include "algest/arithmetic.hpp"
#include "algest/packed.hpp"

namespace algest {

/// Multiply-adds and divisions of triangle_rises_above.
constexpr long triangle_rises_above_cost(int unknowns) noexcept {
    const long n = unknowns;
    return n * n * (n + 1) + n * (n + 1) / 2 + n * (n - 1) / 2 + (n - 1) * n * (n + 1) / 3;
}

/// True where R'R - margin * N is positive definite. triangle: [R|z] packed, as add_rows keeps it; N: n x n, symmetric, destroyed. Looked at as
/// 1 - margin * R'^-1 N R^-1, whose rounding does not grow with the square of R's condition. False where R is singular.
/// Fixed loops, no allocation, never fails. Cost: triangle_rises_above_cost.
template <class S>
inline bool triangle_rises_above(const S* triangle, int unknowns, S margin, S* N) noexcept {
    const int n = unknowns;
    const auto solve_along = [&](S* x, int stride) {   // x <- R'^-1 x
        for (int i = 0; i < n; ++i) {
            S sum = x[i * stride];
            for (int k = 0; k < i; ++k) sum -= triangle[packed_index(n + 1, k, i)] * x[k * stride];
            x[i * stride] = sum / triangle[packed_index(n + 1, i, i)];
        }
    };
    for (int c = 0; c < n; ++c) solve_along(N + c, n);
    for (int r = 0; r < n; ++r) solve_along(N + r * n, 1);
    bool above = true;
    for (int i = 0; i < n; ++i) {   // L D L', L below the diagonal
        for (int j = 0; j <= i; ++j) {
            S sum = (i == j ? S(1) : S(0)) - margin * N[i * n + j];
            for (int k = 0; k < j; ++k) sum -= N[i * n + k] * N[j * n + k] * N[k * n + k];
            const bool usable = sum > S(0);
            if (i == j) above = above && usable;
            N[i * n + j] = i != j ? sum / N[j * n + j] : usable ? sum : S(1);
        }
    }
    return above;
}

}  // namespace algest
