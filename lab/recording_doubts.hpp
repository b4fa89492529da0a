// SPDX-License-Identifier: GPL-3.0-or-later
// What a recording may hide whatever the model: sensors at their limits, inputs that say nothing, holds that do not fit.
#pragma once
#include <string>
#include <vector>

#include "lab/simulate.hpp"

namespace algest::lab {

/// A sentence for each: a scored output that stands at an extreme, a signal beyond its declared limits, an input that never changes, and one
/// that stands still between jumps but is declared linear. Cost: the recording, once.
std::vector<std::string> recording_doubts(const model::Model& model, const Bench& bench);

}  // namespace algest::lab
