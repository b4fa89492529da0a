// SPDX-License-Identifier: MIT-0
// The robust form: S(t) theta = q(t), S symmetric positive definite, by a scaled L D L' (Delpoux, Floquet, equation 19).
#pragma once
#include <cmath>
#include <limits>

#include "algest/arithmetic.hpp"
#include "algest/packed.hpp"
#include "algest/triangular.hpp"

namespace algest {

/// Scalars of scratch that solve_gram needs.
constexpr int solve_gram_scratch(int unknowns) noexcept { return unknowns * unknowns + 3 * unknowns; }

/// Solves with the packed upper triangle of [P|Q]'[P|Q] (size unknowns + 1). S is scaled to a unit diagonal, so that
/// pivots and condition speak of the data and not of units. Condition: sqrt(trace(S) trace(S^-1)) of the scaled S, which is
/// |R|_F |R^-1|_F of all rows stacked, as the other solvers report it; S itself has its square. Rank test: a pivot at or
/// below unknowns * epsilon. Fixed loops, no allocation, never throws; takes as long where S is singular. On `regular == false` the
/// solution is untouched.
/// Cost: about unknowns^3 / 2 operations and unknowns square roots.
template <class S>
inline Solved<S> solve_gram(const S* gram, int unknowns, S* scratch, S* solution) noexcept {
    const int n = unknowns;
    bool regular = true;
    S* lower = scratch;             // n x n, unit lower triangle L, D on the diagonal
    S* scale = scratch + n * n;
    S* x = scale + n;
    S* inverse_column = x + n;

    for (int i = 0; i < n; ++i) {
        const S diagonal = gram[packed_index(n + 1, i, i)];
        const bool usable = diagonal > S(0) && std::isfinite(diagonal);
        regular = regular && usable;
        scale[i] = std::sqrt(usable ? diagonal : S(1));
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            S sum = i == j ? S(1) : gram[packed_index(n + 1, j, i)] / scale[i] / scale[j];
            for (int k = 0; k < j; ++k) sum -= lower[i * n + k] * lower[j * n + k] * lower[k * n + k];
            if (i == j) {
                const bool usable = sum > smallest_pivot<S>(n);
                regular = regular && usable;
                lower[i * n + i] = usable ? sum : S(1);
            } else {
                lower[i * n + j] = sum / lower[j * n + j];
            }
        }
    }

    S inverse_trace = S(0);         // sum of squares of L^-1, each row divided by its pivot
    for (int j = 0; j < n; ++j) {
        inverse_column[j] = S(1);
        inverse_trace += S(1) / lower[j * n + j];
        for (int i = j + 1; i < n; ++i) {
            S sum = S(0);
            for (int k = j; k < i; ++k) sum += lower[i * n + k] * inverse_column[k];
            inverse_column[i] = -sum;
            inverse_trace += sum * sum / lower[i * n + i];
        }
    }

    for (int i = 0; i < n; ++i) {
        S sum = gram[packed_index(n + 1, i, n)] / scale[i];
        for (int k = 0; k < i; ++k) sum -= lower[i * n + k] * x[k];
        x[i] = sum;
    }
    for (int i = 0; i < n; ++i) x[i] /= lower[i * n + i];
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k) x[i] -= lower[k * n + i] * x[k];
    }
    if (!regular || !all_finite(x, n)) return {false, std::numeric_limits<S>::infinity()};
    for (int i = 0; i < n; ++i) solution[i] = x[i] / scale[i];
    return {true, std::sqrt(S(n) * inverse_trace)};
}

/// Scalars of scratch that rises_above needs.
constexpr int rises_above_scratch(int unknowns) noexcept { return unknowns * unknowns + unknowns; }

/// True where S minus `floor` (packed upper triangle, unknowns) is positive definite: where every combination of the unknowns is seen by more than
/// the floor. gram: as solve_gram takes it. A combination that noise alone moves would pass the rank test, for noise is regular. Fixed loops.
/// Cost: about unknowns^3 / 3 operations and unknowns square roots.
template <class S>
inline bool rises_above(const S* gram, const S* floor, int unknowns, S* scratch) noexcept {
    const int n = unknowns;
    bool above = true;
    S* lower = scratch;             // as in solve_gram
    S* scale = scratch + n * n;
    for (int i = 0; i < n; ++i) {
        const S diagonal = gram[packed_index(n + 1, i, i)];
        const bool usable = diagonal > S(0) && std::isfinite(diagonal);
        above = above && usable;
        scale[i] = std::sqrt(usable ? diagonal : S(1));
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            S sum = (gram[packed_index(n + 1, j, i)] - floor[packed_index(n, j, i)]) / scale[i] / scale[j];
            for (int k = 0; k < j; ++k) sum -= lower[i * n + k] * lower[j * n + k] * lower[k * n + k];
            if (i == j) {
                const bool usable = sum > smallest_pivot<S>(n);
                above = above && usable;
                lower[i * n + i] = usable ? sum : S(1);
            } else {
                lower[i * n + j] = sum / lower[j * n + j];
            }
        }
    }
    return above;
}

}  // namespace algest
