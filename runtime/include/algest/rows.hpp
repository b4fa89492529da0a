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

/// The rows of one instant while functionals are added to them; row_entries each.
template <class S>
struct RowSums {
    S* matrix;   ///< [P|Q]
    S* size;     ///< sum of the absolute values in an entry
};

/// The rows before any functional is added.
template <class S>
inline void clear_rows(const RowSet<S>& set, S* matrix) noexcept {
    const int entries = row_entries(set.rows, set.unknowns);
    for (int i = 0; i < entries; ++i) matrix[i] = S(0);
}
template <class S>
inline void clear_rows(const RowSet<S>& set, RowSums<S> to) noexcept {
    clear_rows(set, to.matrix);
    clear_rows(set, to.size);
}

/// Adds the value of one functional to the entries that it enters.
template <class S>
inline void add_functional(const RowSet<S>& set, const Functional& f, S value, S* matrix) noexcept {
    for (int i = f.first_term; i < f.first_term + f.terms; ++i) {
        const Term<S>& term = set.terms[i];
        matrix[term.row * (set.unknowns + 1) + term.column] += term.factor * value;
    }
}
/// The same with the sum of absolute values behind it.
template <class S>
inline void add_functional(const RowSet<S>& set, const Functional& f, S value, S size, RowSums<S> to) noexcept {
    const int columns = set.unknowns + 1;
    const Term<S>* term = set.terms.data + f.first_term;
    for (const Term<S>* const end = term + f.terms; term != end; ++term) {
        const int entry = term->row * columns + term->column;
        to.matrix[entry] += term->factor * value;
        to.size[entry] += std::abs(term->factor) * size;
    }
}

/// Makes zero of entries that are no larger than `part` of their size, their own rounding: scaled to the size of data they would pass for some,
/// where a kernel erases a signal at rest.
template <class S>
inline void drop_rounding(const RowSet<S>& set, S part, RowSums<S> of) noexcept {
    const int entries = row_entries(set.rows, set.unknowns);
    for (int i = 0; i < entries; ++i) {
        if (std::abs(of.matrix[i]) <= part * of.size[i] && std::isfinite(of.size[i])) of.matrix[i] = S(0);
    }
}

/// Dot products that are evaluated at once: more would not fit into sixteen vector registers.
constexpr int most_dots = 3;

/// Functionals from `first` on, at most most_dots, that read the same window.
template <class S>
inline int of_one_window(const RowSet<S>& set, int first) noexcept {
    const auto reads = [&](int f) { return f < set.functionals.size && set.functionals[f].table != no_table && set.functionals[f].signal == set.functionals[first].signal; };
    int count = 1;
    while (count < most_dots && reads(first + count)) ++count;
    return count;
}

/// Adds `count` functionals of one window, from `first` on.
template <int count, class S>
inline void add_dots(const RowSet<S>& set, int first, const S* samples, RowSums<S> to) noexcept {
    const S* weights[count];
    S values[count];
    S sizes[count];
    for (int t = 0; t < count; ++t) weights[t] = set.tables.data + static_cast<long>(set.functionals[first + t].table) * set.samples;
    dots<count>(weights, samples, set.samples, values);
    dot_sizes<count>(weights, samples, set.samples, sizes);
    for (int t = 0; t < count; ++t) add_functional(set, set.functionals[first + t], values[t], sizes[t], to);
}

/// Evaluates all rows on the windows: matrix[row * (unknowns + 1) + column], the known side in the last column. An entry that is no
/// larger than its own rounding is zero.
/// scratch: row_entries. Cost: functionals * (samples + size_products) multiply-adds. Never fails; a value that is not finite passes through.
template <class S>
inline void evaluate_rows(const RowSet<S>& set, const S* rings, WindowPosition at, S* matrix, S* scratch) noexcept {
    const RowSums<S> sums = {matrix, scratch};
    clear_rows(set, sums);
    for (int f = 0; f < set.functionals.size;) {
        const Functional& first = set.functionals[f];
        if (first.table == no_table) {
            add_functional(set, first, S(1), S(1), sums);
            ++f;
            continue;
        }
        const S* const samples = window(rings, first.signal, at);
        const int count = of_one_window(set, f);
        if (count == 3) add_dots<3>(set, f, samples, sums);
        else if (count == 2) add_dots<2>(set, f, samples, sums);
        else add_dots<1>(set, f, samples, sums);
        f += count;
    }
    drop_rounding(set, rounding_part<S>(set.samples), sums);
}

}  // namespace algest
