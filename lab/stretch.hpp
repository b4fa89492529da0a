// SPDX-License-Identifier: GPL-3.0-or-later
// What of a recording an estimator is fed with: a stretch of its rows, and the columns of the plan's inputs.
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/plan.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// Seconds of a recording's own `t`, both ends included.
struct Stretch {
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
};

/// Rows of a recording: [begin, end).
struct RowRange {
    std::size_t begin;
    std::size_t end;
    std::size_t size() const { return end - begin; }
};

/// Cost: log(rows).
RowRange rows_of(const Recording& recording, const Stretch& stretch);

/// The samples of every input, in the order of plan.inputs; false, and errors in `diagnostics`, if one is not to be had.
bool read_inputs(const plan::Plan& plan, const Recording& recording, std::vector<std::vector<double>>& inputs, Diagnostics& diagnostics);

}  // namespace algest::lab
