// SPDX-License-Identifier: MIT-0
// What errors of their means make of the rows of operating points, kept as sums beside the triangle, so that a point costs the same however many there are:
// the Gram matrix of the changes, what the residuals ought to be and what they are, and the moments that the parameters' covariance is made of.
#pragma once
#include <cstdint>

#include "algest/arithmetic.hpp"
#include "algest/noise.hpp"
#include "algest/packed.hpp"
#include "algest/rows.hpp"
#include "algest/view.hpp"
#include "algest/window.hpp"

namespace algest {

/// Which entries of [P|Q] the rows of an operating point have, as data. groups == 0: nothing is kept.
struct PointRows {
    View<std::uint16_t> first;     ///< rows + 1 entries: where each row's columns begin
    View<std::uint16_t> columns;   ///< ascending; the last of each row is the known side
    View<std::uint16_t> group;     ///< of each row: the sum that its residuals are counted in
    int groups;

    constexpr int rows() const noexcept { return group.size; }
    constexpr int width(int row) const noexcept { return first[row + 1] - first[row]; }
    constexpr int column(int row, int place) const noexcept { return columns[first[row] + place]; }
};

/// Scalars of the sums that estimate needs: dP'dP (packed), dP'dQ, then dQ^2 and the squared residuals of each group.
constexpr int point_noise_scalars(int unknowns, int groups) noexcept { return groups == 0 ? 0 : packed_size(unknowns) + unknowns + 2 * groups; }
constexpr int group_place(int unknowns, int group) noexcept { return packed_size(unknowns) + unknowns + 2 * group; }

/// Products of the changes of two rows, as they are kept: all of two rows, the upper triangle of one with itself.
constexpr int change_products(const PointRows& points, int r, int s) noexcept { return r == s ? packed_size(points.width(r)) : points.width(r) * points.width(s); }
/// Products of the entries of two rows, without the known side.
constexpr int entry_products(const PointRows& points, int r, int s) noexcept {
    return r == s ? packed_size(points.width(r) - 1) : (points.width(r) - 1) * (points.width(s) - 1);
}
constexpr int all_change_products(const PointRows& points) noexcept {
    int out = 0;
    for (int r = 0; r < points.rows(); ++r) for (int s = r; s < points.rows(); ++s) out += change_products(points, r, s);
    return out;
}
/// Scalars of the moments.
constexpr int point_moments(const PointRows& points) noexcept {
    int out = 0;
    for (int r = 0; r < points.rows(); ++r) for (int s = r; s < points.rows(); ++s) out += entry_products(points, r, s) * change_products(points, r, s);
    return out;
}

namespace detail {

/// The mean of d[P|Q]'d[P|Q], row by row and of every two rows: one noisy input after the other. A change that is not finite is left out.
template <class S>
inline void products_of_changes(const RowSet<S>& set, const Noise<S>& noise, const PointRows& points, const S* rings, WindowPosition at, S* change, S* products) noexcept {
    const int width = set.unknowns + 1;
    for (int k = 0; k < all_change_products(points); ++k) products[k] = S(0);
    for (int input = 0; input < noise.inputs; ++input) {
        noise_in_rows(set, noise, rings, at, input, 0, change);
        if (!all_finite(change, row_entries(set.rows, set.unknowns))) continue;
        S* to = products;
        for (int r = 0; r < points.rows(); ++r) {
            for (int s = r; s < points.rows(); ++s) {
                for (int a = 0; a < points.width(r); ++a) {
                    for (int b = r == s ? a : 0; b < points.width(s); ++b) *to++ += change[r * width + points.column(r, a)] * change[s * width + points.column(s, b)];
                }
            }
        }
    }
}

/// Adds a row's products with itself to the sums of estimate.
template <class S>
inline void add_products(const PointRows& points, int row, int unknowns, const S* products, S* sums) noexcept {
    for (int a = 0; a < points.width(row); ++a) {
        for (int b = a; b < points.width(row); ++b, ++products) {
            const int u = points.column(row, a);
            const int v = points.column(row, b);
            const int place = v < unknowns ? packed_index(unknowns, u, v) : u < unknowns ? packed_size(unknowns) + u : group_place(unknowns, points.group[row]);
            sums[place] += *products;
        }
    }
}

}  // namespace detail

/// Multiply-adds of add_point. noisy: inputs with noise; products: of noise_in_rows, over all of them.
constexpr long add_point_cost(const PointRows& points, long noisy, long products, bool forgets, int unknowns) noexcept {
    long out = products + noisy * all_change_products(points) + point_moments(points);
    for (int r = 0; r < points.rows(); ++r) for (int s = r; s < points.rows(); ++s) out += entry_products(points, r, s);
    return out + (forgets ? point_noise_scalars(unknowns, points.groups) + point_moments(points) + 2 : 0);
}

/// Adds what noise makes of the rows [P|Q] of the newest operating point: to `sums`, and to `moments` P_ri P_sj E(d[P|Q]_ra d[P|Q]_sb) for every two rows r
/// and s of the point. keep: as of add_rows. scratch: row_entries + all_change_products. Windows of one sample, without lags. Cost: add_point_cost. Never fails.
template <class S>
inline void add_point(const RowSet<S>& set, const Noise<S>& noise, const PointRows& points, const S* rings, WindowPosition at, S keep, const S* rows, S* scratch, S* sums,
                      S* moments) noexcept {
    const int width = set.unknowns + 1;
    S* const products = scratch + row_entries(set.rows, set.unknowns);
    detail::products_of_changes(set, noise, points, rings, at, scratch, products);
    if (keep != S(1)) {
        const S square = keep * keep;
        const S fourth = square * square;
        for (int k = 0; k < point_noise_scalars(set.unknowns, points.groups); ++k) sums[k] *= square;
        for (int k = 0; k < point_moments(points); ++k) moments[k] *= fourth;
    }
    const S* from = products;
    for (int r = 0; r < points.rows(); ++r) {
        detail::add_products(points, r, set.unknowns, from, sums);
        for (int s = r; s < points.rows(); ++s) {
            const int size = change_products(points, r, s);
            for (int i = 0; i < points.width(r) - 1; ++i) {
                for (int j = r == s ? i : 0; j < points.width(s) - 1; ++j) {
                    const S entries = rows[r * width + points.column(r, i)] * rows[s * width + points.column(s, j)];
                    for (int k = 0; k < size; ++k) *moments++ += entries * from[k];
                }
            }
            from += size;
        }
    }
}

/// Adds the squared residuals of the rows that add_rows has rotated: it leaves in the last column of each what no unknown explains.
template <class S>
inline void add_residuals(const PointRows& points, const S* rotated, int unknowns, S* sums) noexcept {
    for (int r = 0; r < points.rows(); ++r) {
        const S residual = rotated[r * (unknowns + 1) + unknowns];
        sums[group_place(unknowns, points.group[r]) + 1] += residual * residual;
    }
}

/// Multiply-adds of expected_residuals.
constexpr long expected_residuals_cost(int columns) noexcept { return columns * (columns + 2L); }

/// What the squared residuals of a group ought to be, by the errors of the means alone: the mean of ||dP u - dQ||^2. u: what the group's columns, `columns`
/// of them from `first` on, are multiplied by. Cost: expected_residuals_cost.
template <class S>
inline S expected_residuals(const S* sums, int unknowns, int group, int first, int columns, const S* u) noexcept {
    S out = sums[group_place(unknowns, group)];
    for (int i = 0; i < columns; ++i) {
        S sum = -S(2) * sums[packed_size(unknowns) + first + i];
        for (int j = 0; j < columns; ++j) sum += sums[packed_index(unknowns, first + (i < j ? i : j), first + (i < j ? j : i))] * u[j];
        out += u[i] * sum;
    }
    return out;
}

/// How many times as large as they ought to be squared residuals are; 1 where they are smaller, or where nobody knows how large they ought to be.
template <class S>
inline S residual_excess(S found, S expected) noexcept {
    return expected > S(0) && found > expected ? found / expected : S(1);
}

}  // namespace algest
