// SPDX-License-Identifier: GPL-3.0-or-later
// What speaks against a number that least squares gave: that it is hardly told from zero, or on the wrong side of what is known of it.
#pragma once
#include <optional>
#include <string>

#include "generator/model.hpp"

namespace algest::lab {

/// A value within this many of its standard deviations is hardly told from zero: even its sign is no finding. Chosen: three, not two, since deviations
/// from residuals or from declared noise know nothing of what the model lacks, and a real machine's model lacks something.
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

/// True where a value lies within that of its deviation.
bool hardly_told_from_zero(double value, double deviation);

}  // namespace algest::lab
