// SPDX-License-Identifier: MIT-0
// Rows of one instant made equally certain and uncorrelated: divided by the Cholesky factor of the covariance that the sensors' noise gives
// their residuals. That covariance depends on the parameters (errors in variables): it is taken at the last ok estimate.
#pragma once
#include <cmath>

#include "algest/noise.hpp"
#include "algest/triangular.hpp"

namespace algest {

/// Scalars of scratch that residual_factor needs.
constexpr int residual_factor_scratch(int rows, int unknowns) noexcept { return rows * (unknowns + 1) + rows; }

/// lower (rows x rows): L with L L' = covariance of the residuals P theta - Q of the window at `at`. False if it is not positive definite
/// (a row without noise). Cost: samples x noisy signals x (noise_in_rows and rows^2); rows square roots.
template <class S>
inline bool residual_factor(const RowSet<S>& set, const Noise<S>& noise, const S* rings, WindowPosition at, const S* theta, S* scratch,
                            S* lower) noexcept {
    const int n = set.rows;
    S* matrix = scratch;
    S* change = scratch + n * (set.unknowns + 1);
    for (int i = 0; i < n * n; ++i) lower[i] = S(0);
    for (int k = -largest_lag(noise); k < set.samples; ++k) {
        for (int s = 0; s < noise.inputs; ++s) {
            noise_in_rows(set, noise, rings, at, s, k, matrix);
            for (int r = 0; r < n; ++r) change[r] = residual(matrix + r * (set.unknowns + 1), theta, set.unknowns);
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j <= i; ++j) lower[i * n + j] += change[i] * change[j];
            }
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            S sum = lower[i * n + j];
            for (int k = 0; k < j; ++k) sum -= lower[i * n + k] * lower[j * n + k];
            if (i == j) {
                // what rounding leaves of a row that says nothing of its own
                if (!(sum > smallest_pivot<S>(n) * lower[i * n + i])) return false;
                lower[i * n + i] = std::sqrt(sum);
            } else {
                lower[i * n + j] = sum / lower[j * n + j];
            }
        }
    }
    return true;
}

/// matrix (rows x width) becomes L^-1 matrix. Cost: rows^2 width / 2 operations. The diagonal must not be zero.
template <class S>
inline void whiten(const S* lower, S* matrix, int rows, int width) noexcept {
    for (int c = 0; c < width; ++c) {
        for (int i = 0; i < rows; ++i) {
            S sum = matrix[i * width + c];
            for (int k = 0; k < i; ++k) sum -= lower[i * rows + k] * matrix[k * width + c];
            matrix[i * width + c] = sum / lower[i * rows + i];
        }
    }
}

}  // namespace algest
