// SPDX-License-Identifier: MIT-0
// Decimation: the mean of every signal over `decimate` periods, products averaged at the full rate. A boxcar commutes with d/dt, so that the
// means obey the same equation as the signals and the kernels stay.
#pragma once

namespace algest {

/// State beside the arrays: samples since the block began; trivially copyable.
struct BoxcarProgress {
    int samples;
    int reserved;
};

/// Scalars of state: sum and newest sample of every signal.
constexpr int boxcar_scalars(int signals) noexcept { return 2 * signals; }

/// Adds one sample of every signal; true when it ends a block, whose means are then in `mean`. A block runs from one sample to the
/// decimate-th after it, which begins the next. A held signal's mean counts what acted in between, that is all but the newest sample; that
/// of another is the exact mean of the straight lines between samples. Cost: 3 operations per signal. Never fails.
template <class S>
inline bool average(S* state, BoxcarProgress& progress, const unsigned char* held, int signals, int decimate, const S* sample, S* mean) noexcept {
    S* sum = state;
    S* newest = state + signals;
    const bool begins = progress.samples == 0;
    const bool ends = progress.samples == decimate;
    for (int i = 0; i < signals; ++i) {
        if (!begins) sum[i] += held[i] != 0 ? newest[i] : S(0.5) * (newest[i] + sample[i]);
        if (ends) mean[i] = sum[i] / S(decimate);
        if (begins || ends) sum[i] = S(0);
        newest[i] = sample[i];
    }
    progress.samples = ends ? 1 : progress.samples + 1;
    return ends;
}

}  // namespace algest
