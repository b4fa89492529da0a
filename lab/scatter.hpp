// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the estimates of different windows differ by more than their noise.
#pragma once
#include <optional>

#include "lab/replay.hpp"

namespace algest::lab {

/// How many standard deviations a replay needs for that (add_deviations' `most`): 32 to 64 deviations give a median within a fifth.
constexpr std::size_t deviations_for_scatter = 32;

/// How far the estimates of parameter p lie from their median, in standard deviations of their own: the median of that over the ok samples whose
/// deviation is looked at, times 1.48, so that normal errors give 1. Empty where those are fewer than eight. Estimates of windows that overlap are
/// alike, which makes it smaller, not larger. The same whether deviations were added at few samples or at many. Cost: samples.
std::optional<double> scatter_in_deviations(const Replay& replay, std::size_t p);

/// Of the ok estimates of parameter p: the median distance from their median, times 1.48. Cost: samples.
double spread(const Replay& replay, std::size_t p);

/// Beyond this, something moves the estimates beside the declared noise. Chosen: five; with a motor's right model and its noise 1 is what comes, with dry
/// friction left out 31 (tests/cli/test_replay_doubts.py has both sides).
constexpr double more_than_noise = 5.0;

}  // namespace algest::lab
