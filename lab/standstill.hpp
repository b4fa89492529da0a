// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings in which nothing moves but noise: an estimator that does not know the noise takes it for motion.
#pragma once
#include <optional>
#include <string>

#include "generator/plan.hpp"
#include "lab/stretch.hpp"

namespace algest::lab {

/// A sentence where some input of the plan scatters and none moves: each is constant, or looks like white noise about a constant that is
/// unrelated to that of the others. None for estimators of steady states, which are there for such recordings. Cost: samples x inputs^2.
std::optional<std::string> standstill(const plan::Plan& plan, const Recording& recording, const Stretch& stretch);

}  // namespace algest::lab
