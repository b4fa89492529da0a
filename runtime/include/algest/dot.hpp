// SPDX-License-Identifier: MIT-0
// The one dot product of the product, with a stated order of summation.
#pragma once
#include <cmath>

namespace algest {

/// sum over k of weights[k] * samples[k], k = 0 .. count-1, oldest sample first.
///
/// Order of summation, part of the contract (replay and target agree to the last bit): lane j of eight adds the
/// products k = j, j+8, j+16, ... of the whole groups of eight; the lanes are added as
/// ((0+4)+(2+6)) + ((1+5)+(3+7)); the products left over are added to that one by one.
/// Cost: count multiplications and additions. Needs -ffp-contract=off (the CMake target sets it).
template <class S>
inline S dot(const S* weights, const S* samples, int count) noexcept {
    S lane[8] = {S(0), S(0), S(0), S(0), S(0), S(0), S(0), S(0)};
    int k = 0;
    for (; k + 8 <= count; k += 8) {
        for (int j = 0; j < 8; ++j) lane[j] += weights[k + j] * samples[k + j];
    }
    S sum = ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
    for (; k < count; ++k) sum += weights[k] * samples[k];
    return sum;
}

/// sum over k of |weights[k] * samples[k]|, about: by the midpoint rule over 16 to 31 strides, every product where there are fewer.
/// What dot() may leave of a sum that vanishes is measured by it. Cost: at most 31 multiplications and additions.
template <class S>
inline S dot_size(const S* weights, const S* samples, int count) noexcept {
    const int stride = count < 32 ? 1 : count / 16;
    S sum = S(0);
    for (int k = stride / 2; k < count; k += stride) sum += std::abs(weights[k] * samples[k]);
    return sum * S(stride);
}

}  // namespace algest
