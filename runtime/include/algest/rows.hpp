// SPDX-License-Identifier: MIT-0
// Rows: linear identities  sum_l theta_l K_l[f_l] = K_0[f_0]  on the newest samples of the signals.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "algest/dot.hpp"
#include "algest/view.hpp"
#include "algest/window.hpp"

namespace algest {

/// One functional of one signal, and the terms that its value enters. Table `no_table` is the functional of the
/// constant 1, whose value is 1 here (its exact integral is in the factor).
struct Functional {
    std::uint16_t table;
    std::uint16_t signal;
    std::uint16_t first_term;
    std::uint16_t terms;
};
constexpr std::uint16_t no_table = 0xFFFF;

/// factor * K[f], added to one entry of the rows. Column `unknowns` is the known side.
template <class S>
struct Term {
    std::uint16_t row;
    std::uint16_t column;
    S factor;
};

/// The rows of an estimator as data: shared, constant, without a state.
template <class S>
struct RowSet {
    int samples;    ///< in a window, M + 1
    int signals;    ///< rings
    int rows;       ///< per instant
    int unknowns;   ///< columns
    View<S> tables; ///< table after table, each `samples` weights, oldest sample first
    View<Functional> functionals;
    View<Term<S>> terms;
};

/// Scalars that the rows of one instant take: [P|Q], row after row.
constexpr int row_entries(int rows, int unknowns) noexcept { return rows * (unknowns + 1); }

/// What rounding may leave of an entry whose terms cancel, as a part of the sum of their absolute values. Eight roundings in line: of
/// weight and product, of the three sums over lanes, of factor and its product, of the sum over terms. The additions along a lane, whose
/// roundings are as good as random, add like a random walk (Higham, Mary 2019); their worst case, samples/8, would take small entries
/// of good data with it.
template <class S>
inline S rounding_part(int samples) noexcept {
    return (S(8) + std::sqrt(S(samples) / S(8))) * (std::numeric_limits<S>::epsilon() / S(2));
}

/// Evaluates all rows on the windows: matrix[row * (unknowns + 1) + column], the known side in the last column. An entry that is no
/// larger than its own rounding is zero: scaled to the size of data it would pass for some, where a kernel erases a signal at rest.
/// scratch: row_entries. Cost: functionals * (samples + 31) multiply-adds. Never fails; a value that is not finite passes through.
template <class S>
inline void evaluate_rows(const RowSet<S>& set, const S* rings, WindowPosition at, S* matrix, S* scratch) noexcept {
    const int entries = row_entries(set.rows, set.unknowns);
    S* const size = scratch;   // sum of the absolute values in an entry
    for (int i = 0; i < entries; ++i) matrix[i] = size[i] = S(0);
    for (const Functional& f : set.functionals) {
        S value = S(1);
        S value_size = S(1);
        if (f.table != no_table) {
            const S* const weights = set.tables.data + static_cast<long>(f.table) * set.samples;
            const S* const samples = window(rings, f.signal, at);
            value = dot(weights, samples, set.samples);
            value_size = dot_size(weights, samples, set.samples);
        }
        for (int i = f.first_term; i < f.first_term + f.terms; ++i) {
            const Term<S>& term = set.terms[i];
            const int entry = term.row * (set.unknowns + 1) + term.column;
            matrix[entry] += term.factor * value;
            size[entry] += std::abs(term.factor) * value_size;
        }
    }
    const S part = rounding_part<S>(set.samples);
    for (int i = 0; i < entries; ++i) {
        if (std::isfinite(size[i]) && std::abs(matrix[i]) <= part * size[i]) matrix[i] = S(0);
    }
}

}  // namespace algest
