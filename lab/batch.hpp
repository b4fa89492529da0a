// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares over all rows of a recording at once (001, equation 13), where functional = "derivative": what the estimator absorbs row by row,
// with the rows of the first and of the last sample, at any increasing instants; and what the recording can and cannot tell.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/plan.hpp"
#include "lab/confusion.hpp"
#include "lab/recording.hpp"
#include "lab/stretch.hpp"

namespace algest::lab {

/// One parameter; without a value where the recording does not determine it.
struct BatchParameter {
    std::optional<double> value;
    std::optional<double> deviation;   ///< standard deviation, from the residuals
};

struct Batch {
    std::size_t samples;
    std::size_t instants;                     ///< with rows
    bool uniform;
    std::vector<BatchParameter> parameters;   ///< as plan.parameters
    double condition;                         ///< spectral, of the rows with columns of norm 1; infinity: singular
    double memory;                            ///< instants over which the residuals count as correlated
    std::vector<Confusion> confusions;        ///< those that cannot first

    /// Every parameter has a value.
    bool determined() const { return confusions.empty() || confusions.front().hardly; }
};

/// Directions of the unknowns in which the rows, columns at norm 1, change less than 1/condition_limit of the most are undetermined; below
/// 1/dependent_columns hardly determined.
/// Standard deviations are those of Newey and West (Bartlett weights), with Andrews' choice of how many instants count: residuals of derivative
/// rows are correlated by the filter, those of a model that misses an effect far longer.
/// Nullopt, and errors in `diagnostics`, if the plan is another than derivative rows and least squares, a column does not fit, the stretch is
/// shorter than three samples, or steps differ where a signal is held.
/// Cost: instants x (rows unknowns^2 + memory unknowns^2). Memory: the rows.
std::optional<Batch> batch(const plan::Plan& plan, const Recording& recording, const Stretch& stretch, Diagnostics& diagnostics);

}  // namespace algest::lab
