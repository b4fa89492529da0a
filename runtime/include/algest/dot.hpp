// SPDX-License-Identifier: MIT-0
// The one dot product of the product, with a stated order of summation.
#pragma once

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

}  // namespace algest
