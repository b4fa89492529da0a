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
    static S at(const Lanes& lanes, int) noexcept { return lanes; }
};
template <class S>
struct Neighbours<S, true> {
    typedef S Lanes __attribute__((vector_size(16)));
    typedef S Unaligned __attribute__((vector_size(16), aligned(alignof(S)), may_alias));
    static constexpr int width = 16 / static_cast<int>(sizeof(S));
    static S at(const Lanes& lanes, int j) noexcept { return lanes[j]; }
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
    Lanes lane[tables][parts] = {};
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
        const auto of = [&](int j) { return detail::Neighbours<S>::at(lane[t][j / width], j % width); };
        S sum = ((of(0) + of(4)) + (of(2) + of(6))) + ((of(1) + of(5)) + (of(3) + of(7)));
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

/// sizes[t] = sum over k of |weights[t][k] * samples[k]|, about: by the midpoint rule over 16 to 31 strides, every product where there are fewer.
/// What dots() may leave of a sum that vanishes is measured by it. Cost: at most 31 multiplications and additions a table.
template <int tables, class S>
inline void dot_sizes(const S* const* weights, const S* samples, int count, S* sizes) noexcept {
    const int stride = count < 32 ? 1 : count / 16;
    S sums[tables] = {};
    for (int k = stride / 2; k < count; k += stride) {
        const S x = std::abs(samples[k]);
        for (int t = 0; t < tables; ++t) sums[t] += std::abs(weights[t][k]) * x;
    }
    for (int t = 0; t < tables; ++t) sizes[t] = sums[t] * S(stride);
}

}  // namespace algest
