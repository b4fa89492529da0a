// SPDX-License-Identifier: GPL-3.0-or-later
// Free runs over a stretch of a recording: one long one, or short ones that each start anew from what was measured there.
#pragma once
#include <cstddef>
#include <vector>

#include "lab/simulate.hpp"

namespace algest::lab {

/// Rows [begin, end) of a recording.
struct Rows {
    std::size_t begin;
    std::size_t end;
    std::size_t size() const { return end - begin; }
};

/// Predictions for the rows begin, begin + stride, ... (stride of the bench), by the model's signals; empty for those that do not move,
/// NaN from where a run diverged to its end.
struct Prediction {
    std::vector<std::vector<double>> signals;
    std::size_t rows;
};

/// horizon: samples of a run, a multiple of the stride; 0: one run from `initial` on. Short runs start from `measured_state`.
/// Cost: that of free_run over the rows.
Prediction predict(const Bench& bench, const std::vector<double>& parameters, const std::vector<double>& initial, Rows rows, std::size_t horizon);

/// The state at a row as the recording tells it: value and derivatives of a parabola through the samples around. Entries of hidden
/// signals are taken from `otherwise`.
std::vector<double> measured_state(const Bench& bench, std::size_t row, const std::vector<double>& otherwise);

/// Standard deviation of what a parabola through four samples does not explain of a signal, as white noise that would make it:
/// rms of third differences over sqrt(20).
double roughness(const std::vector<double>& x);

}  // namespace algest::lab
