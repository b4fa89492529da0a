// SPDX-License-Identifier: MIT-0
// S(t) = sum over the last L instants of [P|Q]'[P|Q] (Delpoux, Floquet, equation 19) by additions alone: what a large transient
// leaves behind by rounding would otherwise stay in a small sum after it has gone.
//
// The window is two blocks of half its length, rounded up. One block fills with the newest products while its old ones, kept as sums to their
// block's end, leave one by one; meanwhile the products of the other block are turned into such sums, one a push.
#pragma once
#include "algest/packed.hpp"

namespace algest {

/// Instants in one of the two blocks.
constexpr int gram_block(int instants) noexcept { return (instants + 1) / 2; }

/// Scalars that the sums over `instants` instants of rows with `unknowns` unknowns need.
constexpr int gram_scalars(int unknowns, int instants) noexcept {
    return (2 * gram_block(instants) + 4) * packed_size(unknowns + 1);
}

/// Where the two blocks are.
struct GramProgress {
    int position;   ///< in the newest block: instants that it holds
    int newest;     ///< 0 or 1: the block that fills
    int complete;   ///< blocks complete since the start, at most 2
};

/// True when the sum covers L instants.
constexpr bool gram_is_full(const GramProgress& progress, int instants) noexcept {
    return progress.complete * gram_block(instants) + (progress.complete == 2 ? 0 : progress.position % gram_block(instants)) >= instants;
}

/// Adds one instant's rows (rows x (unknowns+1), as evaluate_rows leaves them); the instant L before leaves the sum.
/// memory: gram_scalars(unknowns, instants), the sum S(t) first. Cost: (rows + 5) * packed_size operations.
template <class S>
inline void add_instant(S* memory, GramProgress& progress, const S* matrix, int rows, int unknowns, int instants) noexcept {
    const int width = unknowns + 1;
    const int size = packed_size(width);
    const int block = gram_block(instants);
    S* sum = memory;
    S* newest_sum = memory + size;        // of the newest block so far
    S* other_sum = memory + 2 * size;     // of the whole other block
    S* tail = memory + 3 * size;          // of the other block from the entry last converted to its end
    S* newest = memory + (4 + static_cast<long>(progress.newest) * block) * size;
    S* other = memory + (4 + static_cast<long>(1 - progress.newest) * block) * size;
    if (progress.position == block) {     // the newest block is complete: the blocks change places
        S* const filled = newest;
        newest = other;
        other = filled;
        progress.newest = 1 - progress.newest;
        progress.position = 0;
        for (int k = 0; k < size; ++k) {
            other_sum[k] = newest_sum[k];
            newest_sum[k] = S(0);
            tail[k] = S(0);
        }
    }
    const int at = progress.position;
    const bool has_other = progress.complete >= 1;
    const int oldest = at + 1 + 2 * block - instants;                // of the newest block's old entries that stay
    const bool has_old = progress.complete == 2 && oldest < block;
    const S* old = newest + static_cast<long>(oldest) * size;
    const bool first_leaves = oldest > block;   // an odd window, the newest block just full: the other one's first entry is out
    S* slot = newest + static_cast<long>(at) * size;
    S* convert = other + static_cast<long>(block - 1 - at) * size;
    int k = 0;
    for (int i = 0; i < width; ++i) {
        for (int j = i; j < width; ++j, ++k) {
            S product = S(0);
            for (int r = 0; r < rows; ++r) product += matrix[r * width + i] * matrix[r * width + j];
            slot[k] = product;
            newest_sum[k] += product;
            S total = newest_sum[k];
            if (has_other) {
                total += first_leaves ? tail[k] : other_sum[k];
                tail[k] += convert[k];
                convert[k] = tail[k];
            }
            if (has_old) total += old[k];
            sum[k] = total;
        }
    }
    ++progress.position;
    if (progress.position == block && progress.complete < 2) ++progress.complete;
}

/// Empties the sums; the blocks need no clearing.
template <class S>
inline void clear_gram(S* memory, GramProgress& progress, int unknowns) noexcept {
    for (int k = 0; k < 4 * packed_size(unknowns + 1); ++k) memory[k] = S(0);
    progress = {0, 0, 0};
}

}  // namespace algest
