// SPDX-License-Identifier: GPL-3.0-or-later
// Signals some time ago: of a recording by its hold between samples, of a run from what it kept.
#pragma once
#include <cstddef>
#include <vector>

namespace algest::lab {

/// A time ago in samples: value = that of the sample `whole` ones ago and the part `rest` of a sample before it, 0 <= rest < 1.
struct SamplesAgo {
    std::size_t whole;
    double rest;
};

/// seconds ago at a period in s; less than nothing counts as nothing. What is within 1e-9 of a whole sample is whole.
SamplesAgo samples_ago(double seconds, double period);

/// A sampled signal at sample `at` + `part` (0 <= part <= 1) less `ago`, held or linear between samples; `before` before the first
/// sample, the last behind the last. `since`: part at which the step began that `part` is in; no step straddles part = ago.rest, where the
/// delayed signal has a sample, so it says which of the two values there is meant.
double past_value(const std::vector<double>& samples, bool held, std::size_t at, double part, double since, SamplesAgo ago, double before);

/// Every sample of a delayed signal: straight between two samples, whatever its hold. Of a held one that is the mean over the period from
/// there on, which is what a window sees. `before` before the first sample.
std::vector<double> delayed_samples(const std::vector<double>& samples, SamplesAgo ago, double before);

/// What a run keeps of a signal that moves, to know it between samples: values and slopes at the samples, the slopes from behind and from
/// ahead, since a step of an input breaks them.
struct MovingPast {
    std::vector<double> value;
    std::vector<double> slope_behind;   ///< per sample, up to the sample
    std::vector<double> slope_ahead;    ///< per sample, from the sample on
};

/// At the newest sample less `ago`, by the cubic through values and slopes; the first value before the first sample.
double past_value(const MovingPast& past, SamplesAgo ago);

}  // namespace algest::lab
