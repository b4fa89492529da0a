// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of a recording without any window: the fit of the free run, where that follows the machine.
#pragma once
#include <optional>
#include <vector>

#include "generator/model.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// By parameter; nullopt where the model cannot be run freely over the recording, or its run is further off than the
/// sensors' noise explains: a fit then bends the parameters to what the model misses.
/// Cost: a fit, of at most `most_effort` operations.
std::optional<std::vector<double>> free_run_reference(const model::Model& model, const Recording& recording);
constexpr double most_effort = 2e9;

}  // namespace algest::lab
