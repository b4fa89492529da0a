// SPDX-License-Identifier: MIT-0
// Rows of very different size, as those of iterated sums (004): each divided by its largest entry. Columns keep their units until they are
// solved, so that the condition is that of the rows as they are.
#pragma once
#include <cmath>
#include <limits>

#include "algest/arithmetic.hpp"
#include "algest/noise_gram.hpp"
#include "algest/packed.hpp"
#include "algest/triangular.hpp"
#include "algest/window.hpp"

namespace algest {

namespace detail {

/// The largest entry of a row's P.
template <class S>
inline S largest_of_row(const S* row, int unknowns) noexcept {
    S largest = S(0);
    for (int c = 0; c < unknowns; ++c) largest = larger(largest, S(std::abs(row[c])));
    return largest;
}

}  // namespace detail

/// Divides each row of [P|Q] (rows x (unknowns+1)) by the largest entry of P in it. False if a row is zero or not finite.
/// Cost: rows * unknowns divisions.
template <class S>
inline bool normalise_rows(S* matrix, int rows, int unknowns) noexcept {
    const int width = unknowns + 1;
    for (int r = 0; r < rows; ++r) {
        S* row = matrix + r * width;
        const S largest = detail::largest_of_row(row, unknowns);
        if (!(largest > S(0)) || !std::isfinite(largest)) return false;
        for (int c = 0; c < width; ++c) row[c] /= largest;
    }
    return true;
}

/// No sample counts as better than this part of the largest: recordings are printed with twelve digits, the last of them worth up to 1e-11 of a
/// number, whose rounding has 1e-11/sqrt(12) as its deviation; 2^-38 is a little more. In float it is the scalar's own.
template <class S>
constexpr S sample_resolution() noexcept {
    return std::numeric_limits<S>::digits > 38 ? S(1) / S(1L << 19) / S(1L << 19) : S(std::numeric_limits<S>::epsilon());
}

/// What noise of the signal in a window makes of rows, as they will be once normalise_rows has divided them (matrix: before it). of_rows: of each
/// row what white noise of deviation 1 makes of dP'dP (packed upper triangle of the unknowns); gram: the sum, likewise. deviation: of the signal, as
/// declared; its resolution counts besides. Cost: samples comparisons, rows unknowns^2 / 2 multiply-adds and divisions.
template <class S>
inline void noise_of_normalised_rows(const S* matrix, int rows, int unknowns, const S* of_rows, const S* signal, int samples, S deviation, S* gram) noexcept {
    S size = S(0);
    for (int k = 0; k < samples; ++k) size = larger(size, S(std::abs(signal[k])));
    const S resolution = sample_resolution<S>() * size;
    const S variance = deviation * deviation + resolution * resolution;
    for (int k = 0; k < packed_size(unknowns); ++k) gram[k] = S(0);
    for (int r = 0; r < rows; ++r) {
        const S largest = detail::largest_of_row(matrix + r * (unknowns + 1), unknowns);
        const S share = std::sqrt(variance) / largest;
        for (int k = 0; k < packed_size(unknowns); ++k) gram[k] += of_rows[r * packed_size(unknowns) + k] * share * share;
    }
}

/// True where the rows that solve_rows has just solved, with the scaling of columns undone by condition_before_scaling, see every combination of the
/// unknowns by `margin` times the noise. matrix and scratch as those left them; noise: packed; triangle: packed_size(unknowns + 1) and square:
/// unknowns^2 of scratch. Cost: triangle_rises_above_cost.
template <class S>
inline bool normalised_rows_rise_above(const S* matrix, int unknowns, const S* scratch, S margin, const S* noise, S* triangle, S* square) noexcept {
    const int n = unknowns;
    const S* const order = scratch + n;
    for (int i = 0; i < n; ++i) {
        for (int j = i; j < n; ++j) {
            const int a = static_cast<int>(order[i]);
            const int b = static_cast<int>(order[j]);
            triangle[packed_index(n + 1, i, j)] = matrix[i * (n + 1) + j];
            square[i * n + j] = square[j * n + i] = noise[a < b ? packed_index(n, a, b) : packed_index(n, b, a)];
        }
    }
    return triangle_rises_above(triangle, n, margin, square);
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
