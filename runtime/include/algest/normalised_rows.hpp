// SPDX-License-Identifier: MIT-0
// Rows of very different size, as those of iterated sums (004): each divided by its largest entry. Columns keep their units until they are
// solved, so that the condition is that of the rows as they are, and a column that is nothing but rounding is found before scaling hides it.
#pragma once
#include <cmath>
#include <limits>

#include "algest/arithmetic.hpp"
#include "algest/rows.hpp"
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

/// True when every column of P has an entry that cannot be rounding alone: the weights of each table add up, without their signs, to at
/// most 1, so that rounding leaves at most samples * epsilon of the largest sample. matrix: as evaluate_rows left it; every entry comes from one
/// term. risen: unknowns scalars of scratch. Cost: signals * samples comparisons, and the terms.
template <class S>
inline bool columns_rise_above_rounding(const RowSet<S>& set, const S* rings, WindowPosition at, const S* matrix, S* risen) noexcept {
    const S rounding = S(set.samples) * std::numeric_limits<S>::epsilon();
    for (int c = 0; c < set.unknowns; ++c) risen[c] = S(0);
    for (int s = 0; s < set.signals; ++s) {
        const S* samples = window(rings, s, at);
        S size = S(0);
        for (int k = 0; k < set.samples; ++k) size = larger(size, S(std::abs(samples[k])));
        for (const Functional& f : set.functionals) {
            if (f.signal != s || f.table == no_table) continue;
            for (int i = f.first_term; i < f.first_term + f.terms; ++i) {
                const Term<S>& term = set.terms[i];
                if (term.column == set.unknowns) continue;
                const S entry = matrix[term.row * (set.unknowns + 1) + term.column];
                if (std::abs(entry) > rounding * std::abs(term.factor) * size) risen[term.column] = S(1);
            }
        }
    }
    for (int c = 0; c < set.unknowns; ++c) {
        if (!(risen[c] > S(0))) return false;
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
