// SPDX-License-Identifier: MIT-0
// The rows of one instant solved at once: exactly if there are as many as unknowns, in the least-squares sense if more.
#pragma once
#include <cmath>
#include <limits>

#include "algest/arithmetic.hpp"
#include "algest/triangular.hpp"

namespace algest {

/// Scalars of scratch that solve_rows needs.
constexpr int solve_rows_scratch(int unknowns) noexcept { return 3 * unknowns; }

/// Solves matrix = [P|Q] (rows x (unknowns+1), destroyed) for solution (unknowns entries).
///
/// Householder QR with column pivoting after scaling: each column to norm 1 and, where rows == unknowns, first each row to
/// norm 1 (that changes no solution; with more rows it would weight them). Rank test: a pivot below unknowns * epsilon
/// of the first. Fixed loops, no allocation, never throws. On `regular == false` the solution is untouched.
/// Cost: about 2 rows unknowns^2 operations and unknowns square roots.
template <class S>
inline Solved<S> solve_rows(S* matrix, int rows, int unknowns, S* scratch, S* solution) noexcept {
    const int width = unknowns + 1;
    const Solved<S> singular = {false, std::numeric_limits<S>::infinity()};
    S* column_norm = scratch;
    S* order = scratch + unknowns;          // column that stands at each place, as a scalar: one scratch array
    S* work = scratch + 2 * unknowns;

    if (rows == unknowns) {
        for (int r = 0; r < rows; ++r) {
            S sum = S(0);
            for (int c = 0; c < unknowns; ++c) sum += matrix[r * width + c] * matrix[r * width + c];
            if (!(sum > S(0)) || !std::isfinite(sum)) return singular;
            const S norm = std::sqrt(sum);
            for (int c = 0; c < width; ++c) matrix[r * width + c] /= norm;
        }
    }
    for (int c = 0; c < unknowns; ++c) {
        S sum = S(0);
        for (int r = 0; r < rows; ++r) sum += matrix[r * width + c] * matrix[r * width + c];
        if (!(sum > S(0)) || !std::isfinite(sum)) return singular;
        column_norm[c] = std::sqrt(sum);
        for (int r = 0; r < rows; ++r) matrix[r * width + c] /= column_norm[c];
        order[c] = S(c);
    }

    S first_pivot = S(0);
    for (int k = 0; k < unknowns; ++k) {
        int best = k;
        S best_norm = S(-1);
        for (int c = k; c < unknowns; ++c) {
            S sum = S(0);
            for (int r = k; r < rows; ++r) sum += matrix[r * width + c] * matrix[r * width + c];
            if (sum > best_norm) {
                best_norm = sum;
                best = c;
            }
        }
        const S length = std::sqrt(best_norm);
        if (k == 0) first_pivot = length;
        if (!(length > smallest_pivot<S>(unknowns) * first_pivot)) return singular;
        if (best != k) {
            for (int r = 0; r < rows; ++r) {
                const S kept = matrix[r * width + k];
                matrix[r * width + k] = matrix[r * width + best];
                matrix[r * width + best] = kept;
            }
            const S kept = order[k];
            order[k] = order[best];
            order[best] = kept;
        }
        const S head = matrix[k * width + k];
        const S pivot = head > S(0) ? -length : length;
        const S reflector_head = head - pivot;               // the reflector v: this head, the column below it
        const S half_square = length * (length + std::abs(head));   // v'v / 2
        for (int c = k + 1; c < width; ++c) {
            S sum = reflector_head * matrix[k * width + c];
            for (int r = k + 1; r < rows; ++r) sum += matrix[r * width + k] * matrix[r * width + c];
            const S scale = sum / half_square;
            matrix[k * width + c] -= scale * reflector_head;
            for (int r = k + 1; r < rows; ++r) matrix[r * width + c] -= scale * matrix[r * width + k];
        }
        matrix[k * width + k] = pivot;
    }

    const S condition = condition_of_upper(matrix, unknowns, width, work);
    back_substitute(matrix, unknowns, width, work);
    if (!all_finite(work, unknowns)) return singular;
    for (int k = 0; k < unknowns; ++k) {
        const int c = static_cast<int>(order[k]);
        solution[c] = work[k] / column_norm[c];
    }
    return {true, condition};
}

}  // namespace algest
