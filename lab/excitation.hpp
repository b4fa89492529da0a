// SPDX-License-Identifier: GPL-3.0-or-later
// What a recording would have to do that it does not: signals that stand still, signals that move alike.
#pragma once
#include <string>
#include <vector>

#include "generator/plan.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// A sentence for each unknown, or group of them, that the rows of the whole recording leave open or nearly so; none for plans that delay,
/// decimate or average, whose rows are not at hand. Cost: the rows of a few windows' worth of instants each.
std::vector<std::string> missing_excitation(const plan::Plan& plan, const Recording& recording);

}  // namespace algest::lab
