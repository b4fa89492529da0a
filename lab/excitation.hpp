// SPDX-License-Identifier: GPL-3.0-or-later
// What a recording would have to do that it does not: signals that stand still, signals that move alike.
#pragma once
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "generator/plan.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// A sentence for each unknown, or group of them, that the rows of the whole recording leave open, or that they see by the sensors' noise: where noise that is
/// added once more makes what tells the unknowns apart larger. Columns that are merely alike are told apart by a long and clean recording. Noise: as declared,
/// else the roughness of signals that are not held. None for plans that delay, decimate or average, whose rows are not at hand.
/// Cost: twice the rows of a few windows' worth of instants each.
std::vector<std::string> missing_excitation(const model::Model& model, const plan::Plan& plan, const Recording& recording);

}  // namespace algest::lab
