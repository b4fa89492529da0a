// SPDX-License-Identifier: MIT-0
// Rows of very different size, as those of iterated sums (004): each divided by its largest entry. Columns keep their units until they are
// solved, so that the condition is that of the rows as they are.
#pragma once
#include <cmath>

#include "algest/arithmetic.hpp"
#include "algest/triangular.hpp"

namespace algest {

/// Divides each row of [P|Q] (rows x (unknowns+1)) by the largest entry of P in it. False if a row is zero or not finite.
/// Cost: rows * unknowns divisions.
template <class S>
inline bool normalise_rows(S* matrix, int rows, int unknowns) noexcept {
    const int width = unknowns + 1;
    for (int r = 0; r < rows; ++r) {
        S* row = matrix + r * width;
        S largest = S(0);
        for (int c = 0; c < unknowns; ++c) largest = larger(largest, S(std::abs(row[c])));
        if (!(largest > S(0)) || !std::isfinite(largest)) return false;
        for (int c = 0; c < width; ++c) row[c] /= largest;
    }
    return true;
}

/// The condition of the rows that solve_rows has just solved, without the scaling of columns that it did: matrix and scratch as it left them;
/// both are changed. As condition_of_upper: an upper bound, at most unknowns times too large. Cost: unknowns^3 / 3 operations.
template <class S>
inline S condition_before_scaling(S* matrix, int unknowns, S* scratch) noexcept {
    const int width = unknowns + 1;
    const S* column_norm = scratch;
    const S* order = scratch + unknowns;
    for (int k = 0; k < unknowns; ++k) {
        for (int i = 0; i <= k; ++i) matrix[i * width + k] *= column_norm[static_cast<int>(order[k])];
    }
    return condition_of_upper(matrix, unknowns, width, scratch + 2 * unknowns);
}

}  // namespace algest
