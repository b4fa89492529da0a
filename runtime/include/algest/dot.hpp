// SPDX-License-Identifier: MIT-0
// The one dot product of the product, with a stated order of summation; several at once where they share their samples.
#pragma once

namespace algest {

/// sums[t] = sum over k of weights[t][k] * samples[k], k = 0 .. count-1, oldest sample first, t = 0 .. tables-1.
///
/// Order of summation, part of the contract (replay and target agree to the last bit): lane j of eight adds the
/// products k = j, j+8, j+16, ... of the whole groups of eight; the lanes are added as
/// ((0+4)+(2+6)) + ((1+5)+(3+7)); the products left over are added to that one by one. Lanes are written as vectors of 16 bytes, which
/// compilers do not make of a loop at -O2; without a vector unit they are scalars.
/// Cost: tables * count multiplications and additions; each sample is read once. Needs -ffp-contract=off (the CMake target sets it).
template <int tables, class S>
inline void dots(const S* const* weights, const S* samples, int count, S* sums) noexcept {
    typedef S Lanes __attribute__((vector_size(16)));
    typedef S Unaligned __attribute__((vector_size(16), aligned(alignof(S)), may_alias));
    constexpr int width = 16 / static_cast<int>(sizeof(S));
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
        const auto of = [&](int j) { return lane[t][j / width][j % width]; };
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

}  // namespace algest
