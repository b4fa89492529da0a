// SPDX-License-Identifier: MIT-0
// S(t) = sum over the last L instants of [P|Q]'[P|Q] (Delpoux, Floquet, equation 19), without drift: a served sum adds
// the newest and removes the oldest, a fresh one only adds; after L instants the fresh one takes over. Rounding thus never
// accumulates over more than 2 L instants.
#pragma once
#include "algest/packed.hpp"

namespace algest {

/// Scalars that the sums over `instants` instants of rows with `unknowns` unknowns need.
constexpr int gram_scalars(int unknowns, int instants) noexcept {
    return (instants + 2) * packed_size(unknowns + 1);
}

/// Position in the ring of instants, and how full the two sums are.
struct GramProgress {
    int next;     ///< ring index that is written next
    int served;   ///< instants in the served sum, at most L
    int fresh;    ///< instants in the fresh sum, less than L
};

/// Adds one instant's rows (rows x (unknowns+1), as evaluate_rows leaves them) and removes the one that leaves the window.
/// memory: gram_scalars(unknowns, instants), the served sum first. Cost: rows * packed_size + 4 * packed_size operations.
template <class S>
inline void add_instant(S* memory, GramProgress& progress, const S* matrix, int rows, int unknowns, int instants) noexcept {
    const int width = unknowns + 1;
    const int size = packed_size(width);
    S* served = memory;
    S* fresh = memory + size;
    S* slot = memory + 2 * size + static_cast<long>(progress.next) * size;
    if (progress.served == instants) {
        for (int k = 0; k < size; ++k) served[k] -= slot[k];
    } else {
        ++progress.served;
    }
    int k = 0;
    for (int i = 0; i < width; ++i) {
        for (int j = i; j < width; ++j, ++k) {
            S sum = S(0);
            for (int r = 0; r < rows; ++r) sum += matrix[r * width + i] * matrix[r * width + j];
            slot[k] = sum;
            served[k] += sum;
            fresh[k] += sum;
        }
    }
    progress.next = progress.next + 1 == instants ? 0 : progress.next + 1;
    if (++progress.fresh == instants) {
        for (int m = 0; m < size; ++m) {
            served[m] = fresh[m];
            fresh[m] = S(0);
        }
        progress.fresh = 0;
    }
}

/// Empties both sums; the ring needs no clearing.
template <class S>
inline void clear_gram(S* memory, GramProgress& progress, int unknowns) noexcept {
    for (int k = 0; k < 2 * packed_size(unknowns + 1); ++k) memory[k] = S(0);
    progress = {0, 0, 0};
}

}  // namespace algest
