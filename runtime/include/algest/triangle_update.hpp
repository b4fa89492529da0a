// SPDX-License-Identifier: MIT-0
// Least squares over all rows since reset: an upper triangle [R|z] that Givens rotations keep, with optional forgetting.
#pragma once
#include <cmath>
#include <limits>

#include "algest/arithmetic.hpp"
#include "algest/packed.hpp"
#include "algest/triangular.hpp"

namespace algest {

/// Scalars that the triangle of `unknowns` unknowns takes: the packed triangle of [R|z] and the root of the residual sum.
constexpr int triangle_scalars(int unknowns) noexcept { return packed_size(unknowns + 1); }

/// Multiply-adds and divisions of add_rows that keeps every row.
constexpr long add_rows_cost(int rows, int unknowns) noexcept { return rows * (7L * (unknowns + 1) + 2L * unknowns * (unknowns + 1)); }

/// Rotates one instant's rows (rows x (unknowns+1), destroyed) into the triangle. `keep` multiplies the old triangle
/// first: 1 keeps every row for good, sqrt(lambda) forgets with factor lambda an instant.
/// Cost: add_rows_cost and rows (unknowns+1) square roots. The rows must be finite. Never fails.
template <class S>
inline void add_rows(S* triangle, S* matrix, int rows, int unknowns, S keep) noexcept {
    const int width = unknowns + 1;
    if (keep != S(1)) {
        for (int k = 0; k < packed_size(width); ++k) triangle[k] *= keep;
    }
    for (int r = 0; r < rows; ++r) {
        S* row = matrix + r * width;
        for (int i = 0; i < width; ++i) {
            S* pivot_row = triangle + packed_index(width, i, i);
            // Divided by the larger first: squares neither overflow nor vanish.
            const S size = larger(std::abs(pivot_row[0]), std::abs(row[i]));
            if (!(size > S(0))) continue;
            const S a = pivot_row[0] / size;
            const S b = row[i] / size;
            const S length = std::sqrt(a * a + b * b);
            const S c = a / length;
            const S s = b / length;
            pivot_row[0] = size * length;
            for (int j = i + 1; j < width; ++j) {
                const S above = pivot_row[j - i];
                pivot_row[j - i] = c * above + s * row[j];
                row[j] = c * row[j] - s * above;
            }
        }
    }
}

/// Scalars of scratch that solve_triangle needs.
constexpr int solve_triangle_scratch(int unknowns) noexcept { return unknowns * (unknowns + 1) + 3 * unknowns; }

/// Multiply-adds and divisions of solve_triangle.
constexpr long solve_triangle_cost(int unknowns) noexcept {
    const long n = unknowns;
    return n * (n + 1) + condition_of_upper_cost(unknowns) + n * (n + 1) / 2 + 2 * n;
}

/// Solves R theta = z after scaling the columns of R to norm 1. Rank test: a diagonal entry at or below
/// unknowns * epsilon. On `regular == false` the solution is untouched. Cost: solve_triangle_cost.
template <class S>
inline Solved<S> solve_triangle(const S* triangle, int unknowns, S* scratch, S* solution) noexcept {
    const int n = unknowns;
    const int width = n + 1;
    const Solved<S> singular = {false, std::numeric_limits<S>::infinity()};
    S* upper = scratch;
    S* scale = scratch + n * width;
    S* x = scale + n;
    S* work = x + n;
    for (int j = 0; j < n; ++j) {
        S sum = S(0);
        for (int i = 0; i <= j; ++i) {
            const S entry = triangle[packed_index(width, i, j)];
            sum += entry * entry;
        }
        if (!(sum > S(0)) || !std::isfinite(sum)) return singular;
        scale[j] = std::sqrt(sum);
        for (int i = 0; i <= j; ++i) upper[i * width + j] = triangle[packed_index(width, i, j)] / scale[j];
        if (!(std::abs(upper[j * width + j]) > smallest_pivot<S>(n))) return singular;
    }
    for (int i = 0; i < n; ++i) upper[i * width + n] = triangle[packed_index(width, i, n)];
    const S condition = condition_of_upper(upper, n, width, work);
    back_substitute(upper, n, width, x);
    if (!all_finite(x, n)) return singular;
    for (int j = 0; j < n; ++j) solution[j] = x[j] / scale[j];
    return {true, condition};
}

}  // namespace algest
