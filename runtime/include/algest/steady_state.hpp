// SPDX-License-Identifier: MIT-0
// Operating points: means over blocks of samples in which nothing drifts (Delpoux, Bodson, Floquet 2014, section 3.1: in a steady state every
// derivative is zero, and averages obey the equations).
#pragma once
#include <cmath>
#include <cstdint>

#include "algest/arithmetic.hpp"

namespace algest {

/// State beside the array: trivially copyable.
struct SteadyProgress {
    std::int32_t samples;   ///< in the block so far
    std::int32_t quarter;   ///< that is being filled, 0 to 3
};

/// Scalars of state: of each quantity its first sample, sum of the quarter, sum of the block, least and largest mean of a quarter; and the stretch.
constexpr int steady_scalars(int quantities) noexcept { return 5 * quantities + 1; }

namespace detail {

template <class S>
inline void begin_block(S* state, SteadyProgress& progress, int quantities, const S* sample) noexcept {
    progress = {0, 0};
    for (int i = 0; i < quantities; ++i) {
        state[i] = sample[i];
        state[quantities + i] = S(0);
        state[2 * quantities + i] = S(0);
    }
}

/// The first sample of a quarter within a block.
constexpr int quarter_start(int block, int quarter) noexcept { return static_cast<int>(static_cast<std::int64_t>(block) * quarter / 4); }

}  // namespace detail

/// Adds one sample of every quantity; true when it ends a block of `block` samples (4 or more) that is steady: `mean` then holds its means. Steady: the
/// means of its four quarters lie within `tolerance` of each other, for each quantity (infinite: not asked). A block that is not is dropped at the quarter
/// that tells, and the next one begins. stretch: a
/// block never crosses a change of this number, and there is none while it is zero; the same number always: no stretches are given.
/// What is constant has that constant as its mean, exactly. Cost: 3 operations a quantity, 8 at the end of a quarter. Never fails.
template <class S>
inline bool average_steady(S* state, SteadyProgress& progress, const S* tolerance, int quantities, int block, S stretch, const S* sample, S* mean) noexcept {
    S* const first = state;
    S* const of_quarter = state + quantities;
    S* const of_block = of_quarter + quantities;
    S* const least = of_block + quantities;
    S* const largest = least + quantities;
    S* const last_stretch = largest + quantities;
    if (stretch != *last_stretch || progress.samples == 0) detail::begin_block(state, progress, quantities, sample);
    *last_stretch = stretch;
    if (!(stretch < S(0) || stretch > S(0))) {
        progress = {0, 0};
        return false;
    }
    for (int i = 0; i < quantities; ++i) of_quarter[i] += sample[i] - first[i];
    ++progress.samples;
    const int end = detail::quarter_start(block, progress.quarter + 1);
    if (progress.samples < end) return false;
    const S in_quarter = S(end - detail::quarter_start(block, progress.quarter));
    bool steady = true;
    for (int i = 0; i < quantities; ++i) {
        const S of_it = of_quarter[i] / in_quarter;
        least[i] = progress.quarter == 0 ? of_it : smaller(least[i], of_it);
        largest[i] = progress.quarter == 0 ? of_it : larger(largest[i], of_it);
        of_block[i] += of_quarter[i];
        of_quarter[i] = S(0);
        steady = steady && largest[i] - least[i] <= tolerance[i];
    }
    ++progress.quarter;
    if (steady && progress.quarter < 4) return false;
    progress = {0, 0};
    for (int i = 0; i < quantities && steady; ++i) mean[i] = first[i] + of_block[i] / S(block);
    return steady;
}

}  // namespace algest
