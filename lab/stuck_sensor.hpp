// SPDX-License-Identifier: GPL-3.0-or-later
// A sensor that shows one value for a long time while the machine is driven.
#pragma once
#include <optional>
#include <string>

#include "generator/model.hpp"
#include "generator/plan.hpp"
#include "lab/recording.hpp"
#include "lab/stretch.hpp"

namespace algest::lab {

/// A sentence where a signal that an equation differentiates stands at one value for as long as a window, and five times as long as at any other time, while
/// another signal moves as it does elsewhere: longer than a sensor that is alive repeats itself, but for half of the stretch at most: what stands longer was not driven. A machine that friction holds looks alike, and is named.
/// Cost: samples x signals.
std::optional<std::string> stuck_sensor(const model::Model& model, const plan::Plan& plan, const Recording& recording, const Stretch& stretch);

}  // namespace algest::lab
