// SPDX-License-Identifier: MIT-0
// Value and derivative of a noisy signal by the parabola filter (Tebaldi, Morselli, Zanasi, section 2, equations 5 to 8
// for equal spacing): two states, one sample of delay.
#pragma once

namespace algest {

/// State of one filtered signal. Trivially copyable.
template <class S>
struct ParabolaFilter {
    S value;   ///< filtered value at the sample before the newest
    S slope;   ///< derivative there, times the sampling period

    /// The first two samples of a run (appendix A of the paper): the value is the first sample, the slope their difference.
    void start(S first, S second) noexcept {
        value = first;
        slope = second - first;
    }

    /// Moves on by one sample: `here` is the sample that the state moves to, `next` the newest one.
    /// Cost: 12 operations. Never fails.
    void advance(S here, S next) noexcept {
        const S miss_here = (value + slope) - here;
        const S miss_next = (value + (slope + slope)) - next;
        const S bend = -(miss_here + S(4) * miss_next) / S(17);   // a T^2, equation (5) with equal spacing
        value = (value + slope) + bend;                            // equation (7)
        slope = slope + (bend + bend);                             // equation (8), times T
    }
};

}  // namespace algest
