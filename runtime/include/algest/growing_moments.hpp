// SPDX-License-Identifier: MIT-0
// Windows that grow from a start or restart on, [0, t], until they slide. Their weights change with every sample, but as polynomials in the
// place v and in h = 1/n, n the intervals of the window. The moments of a growing window stand in a frame of their own, which doubles
// when it is full: coordinates are halved and moved, which loses no digits.
#pragma once
#include <cmath>
#include <type_traits>

#include "algest/moments.hpp"

namespace algest {

/// Weights of growing windows, by table. That of sample m = 0 .. n is h times the sum over i and j of h^i v^j, v = (2m - n)/n; the oldest, which
/// samples are measured from, counts nothing.
struct GrowingSet {
    View<double> polynomials;   ///< (d + 1)^2 a table: by power of v, then by power of h
    View<double> newest;        ///< d + 1 a table: what the newest sample counts besides, by power of h
    View<unsigned char> derivatives;   ///< by table: its value is that of the full window times (M/n)^derivative
    constexpr int tables() const noexcept { return derivatives.size; }
};

namespace detail {

/// sum_i coefficients[i] h^i.
inline double horner(const double* coefficients, int count, double h) noexcept {
    double out = 0.0;
    for (int i = count - 1; i >= 0; --i) out = out * h + coefficients[i];
    return out;
}

}  // namespace detail

/// Takes one sample of every signal, after add_sample and before the window is full. Frame 0 starts with the same sample and measures from it.
/// Cost: signals (degree + 1) products and sums; twice and 1 + signals degree^2/2 more at samples 1, 2, 4, 8, ... Never fails.
template <class S>
inline void add_growing_sample(const MomentSet<S, double>& set, MomentMemory<S, double> memory, const S* sample, double* scratch) noexcept {
    const int newest = static_cast<int>(memory.progress->position);
    const int signals = set.degrees.size;
    const int count = set.degree + 1;
    if (newest == 0) memory.progress->growing = 1;
    const bool full = newest == memory.progress->growing;
    if (full) memory.progress->growing *= 2;
    const int size = static_cast<int>(memory.progress->growing);
    double* const moments = memory.accumulators + moment_frames<double> * signals * count;
    if (newest == 0) {
        for (int i = 0; i < signals * count; ++i) moments[i] = 0.0;
    } else if (full) {   // u becomes (u - 1)/2
        for (int s = 0; s < signals; ++s) {
            detail::shift_moments(set.degree, S(-1), moments + s * count);
            double half = 1.0;
            for (int j = 1; j < count; ++j) moments[s * count + j] *= half *= 0.5;
        }
    }
    const S u = S(2 * newest - (size - 1)) / S(size);
    detail::add_to_frame<false>(set, set.degree, u, S(1), sample, memory.references, memory.sizes, scratch, moments);   // the sizes are those of frame 0
}

/// Evaluates all rows on the window since the start: as evaluate_moment_rows, with the factors of the full window. scratch: moment_scratch.
/// Roundings are counted as there: one of each x - c, and of the sums n/2 + 8, with coordinates of the frame up to 1 and a shift up to 1/2.
/// Cost: signals degree (degree + 1)/2 + functionals (degree + 2) (degree + 3) products and sums.
template <class S>
inline void evaluate_growing_rows(const GrowingSet& growing, const MomentSet<S, double>& set, const RowSet<S>& rows, MomentMemory<S, double> memory, const S* newest_sample,
                                  double* scratch, RowSums<S> to) noexcept {
    const int newest = static_cast<int>(memory.progress->position);
    const int count = set.degree + 1;
    const int size = static_cast<int>(memory.progress->growing);
    const double* const moments = memory.accumulators + moment_frames<double> * rows.signals * count;
    const double h = 1.0 / newest;
    const double stretch = size * h;   // v is u, moved to the middle of the window, times this
    const double ratio = (rows.samples - 1) * h;
    for (int i = 0; i < rows.signals * count; ++i) scratch[i] = moments[i];
    for (int s = 0; s < rows.signals; ++s) detail::shift_moments(set.degree, S(size - 1 - newest) / S(size), scratch + s * count);

    const double roundings = std::is_same<S, double>::value ? (9.0 + 0.5 * (newest + 1)) / 8.0 : 1.0 / 8.0;   // besides eight of the scalar

    clear_rows(rows, to);
    for (const Functional& f : rows.functionals) {
        if (f.table == no_table) {
            add_functional(rows, f, S(1), S(1), to);
            continue;
        }
        const double* const of_signal = scratch + f.signal * count;
        const double* const polynomial = growing.polynomials.data + f.table * count * count;
        double power = h;
        double reach = 1.0;
        double value = 0.0;
        double gain = 0.0;
        for (int j = 0; j < count; ++j) {
            const double coefficient = detail::horner(polynomial + j * count, count, h) * power;
            value += coefficient * of_signal[j];
            gain += std::abs(coefficient) * reach;
            power *= stretch;
            reach *= 1.5;
        }
        const double c = static_cast<double>(memory.references[f.signal]);
        const double of_reference = c * static_cast<double>(set.ends[f.table].of_one);
        value += h * detail::horner(growing.newest.data + f.table * count, count, h) * (static_cast<double>(newest_sample[f.signal]) - c);
        value += of_reference;
        double rounding_of = std::abs(value) + std::abs(of_reference) + roundings * gain * static_cast<double>(memory.sizes[f.signal]);
        for (int i = 0; i < growing.derivatives[f.table]; ++i) {
            value *= ratio;
            rounding_of *= ratio;
        }
        add_functional(rows, f, static_cast<S>(value), static_cast<S>(rounding_of), to);
    }
    drop_rounding(rows, moment_rounding_part<S>(), to);
}

}  // namespace algest
