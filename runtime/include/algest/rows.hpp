// SPDX-License-Identifier: MIT-0
// Rows: linear identities  sum_l theta_l K_l[f_l] = K_0[f_0]  on the newest samples of the signals.
#pragma once
#include <cstdint>

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

/// The rows before any functional is added.
template <class S>
inline void clear_rows(const RowSet<S>& set, S* matrix) noexcept {
    const int entries = set.rows * (set.unknowns + 1);
    for (int i = 0; i < entries; ++i) matrix[i] = S(0);
}

/// Adds the value of one functional to the entries that it enters.
template <class S>
inline void add_functional(const RowSet<S>& set, const Functional& f, S value, S* matrix) noexcept {
    for (int i = f.first_term; i < f.first_term + f.terms; ++i) {
        const Term<S>& term = set.terms[i];
        matrix[term.row * (set.unknowns + 1) + term.column] += term.factor * value;
    }
}

/// Evaluates all rows on the windows: matrix[row * (unknowns + 1) + column], the known side in the last column.
/// Cost: functionals * samples multiply-adds. Never fails; a value that is not finite passes through.
template <class S>
inline void evaluate_rows(const RowSet<S>& set, const S* rings, WindowPosition at, S* matrix) noexcept {
    clear_rows(set, matrix);
    for (const Functional& f : set.functionals) {
        const S value = f.table == no_table
                            ? S(1)
                            : dot(set.tables.data + static_cast<long>(f.table) * set.samples,
                                  window(rings, f.signal, at), set.samples);
        add_functional(set, f, value, matrix);
    }
}

}  // namespace algest
