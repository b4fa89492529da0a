// SPDX-License-Identifier: GPL-3.0-or-later
// What speaks against a number that least squares gave: that it is hardly told from zero, or on the wrong side of what is known of it; that those of
// different windows differ by more than their noise.
#pragma once
#include <optional>
#include <string>

#include "generator/model.hpp"
#include "lab/replay.hpp"

namespace algest::lab {

/// A value within this many of its standard deviations is hardly told from zero: even its sign is no finding. Three, since deviations from residuals
/// know nothing of what the model lacks, and a real machine's model lacks something.
constexpr double told_from_zero = 3.0;

/// The declared min and max of a parameter; infinite where none is.
struct Limits {
    double min;
    double max;
    bool hold(double value) const { return value >= min && value <= max; }
};
Limits limits_of(const model::Parameter& parameter);

/// In words, for people; empty where nothing speaks against the value. deviation: empty where it is not known.
std::optional<std::string> doubt(const model::Parameter& parameter, double value, std::optional<double> deviation);

/// How far the estimates of parameter p lie from their median, in standard deviations of their own: the median of that over the ok samples whose
/// deviation is known, times 1.48, so that normal errors give 1. Empty where those are fewer than eight. Estimates of windows that overlap are alike,
/// which makes it smaller, not larger. Cost: samples.
std::optional<double> scatter_in_deviations(const Replay& replay, std::size_t p);

/// Beyond this, something moves the estimates beside the declared noise. Five: deviations to first order are right within a factor of two.
constexpr double more_than_noise = 5.0;

}  // namespace algest::lab
