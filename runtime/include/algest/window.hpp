// SPDX-License-Identifier: MIT-0
// The newest samples of every signal, each signal contiguous in memory: a mirrored ring.
#pragma once

namespace algest {

/// Where the windows start in rings of `length` samples (each stored twice).
struct WindowPosition {
    int length;   ///< of the ring
    int start;    ///< index of the oldest sample of the window
};

/// Scalars that `signals` rings of `length` samples need.
constexpr int ring_scalars(int signals, int length) noexcept { return 2 * signals * length; }

/// The window of one signal: contiguous, oldest sample first.
template <class S>
inline const S* window(const S* rings, int signal, WindowPosition at) noexcept {
    return rings + 2L * signal * at.length + at.start;
}

/// Writes one sample of every signal at index `head` of the rings, and into the mirror.
template <class S>
inline void write_sample(S* rings, int signals, int length, int head, const S* sample) noexcept {
    for (int i = 0; i < signals; ++i) {
        S* ring = rings + 2L * i * length;
        ring[head] = sample[i];
        ring[head + length] = sample[i];
    }
}

/// Position of the newest `samples` when `head` is the index that is written next.
constexpr WindowPosition newest(int samples, int length, int head) noexcept {
    const int start = head + length - samples;
    return {length, start >= length ? start - length : start};
}

}  // namespace algest
