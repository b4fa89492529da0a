// SPDX-License-Identifier: MIT-0
// Samples of some time ago: a ring of the last samples of each delayed signal.
#pragma once
#include <cstdint>

namespace algest {

/// How far all lines of an estimator are; they have one length. Trivially copyable.
struct DelayProgress {
    std::int32_t head;     ///< place of the oldest sample, which is written next
    std::int32_t filled;   ///< samples since the last restart, at most the length
};

/// Sample `ago` of a line (1: the newest that was kept; at most `length`), as kept: what stands there before so many were is unspecified.
/// Cost: one comparison. Never fails.
template <class S>
inline S past_sample(const S* line, int length, DelayProgress progress, int ago) noexcept {
    const int place = progress.head - ago;
    return line[place < 0 ? place + length : place];
}

/// Keeps one sample of every line, lines one behind the other; the oldest ones go. Cost: one store a line. Never fails.
template <class S>
inline void keep_samples(S* lines, int count, int length, DelayProgress& progress, const S* newest) noexcept {
    for (int i = 0; i < count; ++i) lines[i * length + progress.head] = newest[i];
    progress.head = progress.head + 1 == length ? 0 : progress.head + 1;
    if (progress.filled < length) ++progress.filled;
}

}  // namespace algest
