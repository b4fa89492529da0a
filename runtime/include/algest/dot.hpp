// SPDX-License-Identifier: MIT-0
// The one dot product of the product, with a stated order of summation; several at once where they share their samples.
#pragma once
#include <cmath>
#include <type_traits>

namespace algest {

namespace detail {

/// Neighbours that are multiplied at once, as a unit of 16 bytes has them. Scalars of a class stand alone.
template <class S, bool builtin = std::is_floating_point<S>::value>
struct Neighbours {
    typedef S Lanes;
    typedef S Unaligned;
    static constexpr int width = 1;
    static S sum(const Lanes& lanes) noexcept { return lanes; }
    static Lanes absolute(const Lanes& x) noexcept { return std::abs(x); }
};
template <class S>
struct Neighbours<S, true> {
    typedef S Lanes __attribute__((vector_size(16)));
    typedef S Unaligned __attribute__((vector_size(16), aligned(alignof(S)), may_alias));
    static constexpr int width = 16 / static_cast<int>(sizeof(S));
    /// Halves first: 0+1, or (0+2) + (1+3).
    static S sum(const Lanes& lanes) noexcept {
        if constexpr (width == 2) return lanes[0] + lanes[1];
        else return (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
    }
    static Lanes absolute(const Lanes& x) noexcept {
        Lanes out = x;
        for (int j = 0; j < width; ++j) out[j] = std::abs(x[j]);
        return out;
    }
};

}  // namespace detail

/// sums[t] = sum over k of weights[t][k] * samples[k], k = 0 .. count-1, oldest sample first, t = 0 .. tables-1.
///
/// Order of summation, part of the contract (replay and target agree to the last bit): lane j of eight adds the
/// products k = j, j+8, j+16, ... of the whole groups of eight; the lanes are added as
/// ((0+4)+(2+6)) + ((1+5)+(3+7)); the products left over are added to that one by one. Lanes are written as vectors of 16 bytes, which
/// compilers do not make of a loop at -O2; without a vector unit they are scalars.
/// Cost: tables * count multiplications and additions; each sample is read once. Needs -ffp-contract=off (the CMake target sets it).
template <int tables, class S>
inline void dots(const S* const* weights, const S* samples, int count, S* sums) noexcept {
    using Unaligned = typename detail::Neighbours<S>::Unaligned;
    using Lanes = typename detail::Neighbours<S>::Lanes;
    constexpr int width = detail::Neighbours<S>::width;
    constexpr int parts = 8 / width;
    Lanes lane[tables][parts];
#pragma GCC unroll 8
    for (int t = 0; t < tables; ++t) {
#pragma GCC unroll 8
        for (int j = 0; j < parts; ++j) lane[t][j] = Lanes{};   // `= {}` for all of them would go through memory
    }
    int k = 0;
    for (; k + 8 <= count; k += 8) {
#pragma GCC unroll 8
        for (int j = 0; j < parts; ++j) {
            const Lanes x = *reinterpret_cast<const Unaligned*>(samples + k + j * width);
#pragma GCC unroll 8
            for (int t = 0; t < tables; ++t) lane[t][j] += *reinterpret_cast<const Unaligned*>(weights[t] + k + j * width) * x;
        }
    }
#pragma GCC unroll 8
    for (int t = 0; t < tables; ++t) {
#pragma GCC unroll 8
        for (int half = parts / 2; half > 0; half /= 2) {
#pragma GCC unroll 8
            for (int j = 0; j < half; ++j) lane[t][j] += lane[t][j + half];
        }
        S sum = detail::Neighbours<S>::sum(lane[t][0]);
        for (int j = k; j < count; ++j) sum += weights[t][j] * samples[j];
        sums[t] = sum;
    }
}

template <class S>
inline S dot(const S* weights, const S* samples, int count) noexcept {
    S sum;
    dots<1>(&weights, samples, count, &sum);
    return sum;
}

namespace detail {

/// Samples from one group of neighbours that dot_sizes multiplies to the next, and where the first begins.
template <class S>
constexpr int size_stride(int count) noexcept {
    return count < 16 * Neighbours<S>::width ? Neighbours<S>::width : count / 8;
}
template <class S>
constexpr int first_of_sizes(int count) noexcept {
    return (size_stride<S>(count) - Neighbours<S>::width) / 2;
}

}  // namespace detail

/// Products that dot_sizes forms for a table: all of few samples, else those of 8 to 12 groups.
template <class S>
constexpr int size_products(int count) noexcept {
    constexpr int width = detail::Neighbours<S>::width;
    const int stride = detail::size_stride<S>(count);
    return stride == width ? count : ((count - width - detail::first_of_sizes<S>(count)) / stride + 1) * width;
}

/// sizes[t] = sum over k of |weights[t][k] * samples[k]|, about: by the midpoint rule over 8 to 12 strides, each with the products of neighbours in
/// its middle; every product where there are fewer. What dots() may leave of a sum that vanishes is measured by it.
/// Cost: size_products multiplications and additions a table, 63 at most (double: 31).
template <int tables, class S>
inline void dot_sizes(const S* const* weights, const S* samples, int count, S* sizes) noexcept {
    using Unaligned = typename detail::Neighbours<S>::Unaligned;
    using Lanes = typename detail::Neighbours<S>::Lanes;
    constexpr int width = detail::Neighbours<S>::width;
    const int stride = detail::size_stride<S>(count);
    Lanes lanes[tables];
#pragma GCC unroll 8
    for (int t = 0; t < tables; ++t) lanes[t] = Lanes{};
    int k = detail::first_of_sizes<S>(count);
    for (; k + width <= count; k += stride) {
        const Lanes x = *reinterpret_cast<const Unaligned*>(samples + k);
#pragma GCC unroll 8
        for (int t = 0; t < tables; ++t) {
            const Lanes product = *reinterpret_cast<const Unaligned*>(weights[t] + k) * x;
            lanes[t] += detail::Neighbours<S>::absolute(product);
        }
    }
#pragma GCC unroll 8
    for (int t = 0; t < tables; ++t) {
        S sum = detail::Neighbours<S>::sum(lanes[t]);
        for (int j = k; stride == width && j < count; ++j) sum += std::abs(weights[t][j] * samples[j]);
        sizes[t] = sum * (S(stride) / S(width));
    }
}

}  // namespace algest
