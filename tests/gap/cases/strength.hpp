// SPDX-License-Identifier: GPL-3.0-or-later
// How strong a hidden thing must be to leave a wanted gap, after the model's parameters did what they can.
#pragma once
#include <string>
#include <vector>

#include "refit.hpp"

namespace algest::gap {

constexpr double sensor_share = 0.004;  ///< sensor noise over the signal's size

/// max(std, 0.1 rms): what errors are compared with.
double size_of(const std::vector<double>& v);

/// Sizes of the states in the experiment, nothing hidden.
State sizes(const System& system, const std::vector<double>& p);

/// What a machine's experiment gives; no outputs where it diverges.
Truth truth_of(const Machine& machine);

/// How visible: weak, plain or strong, as a ratio of the gap to the floor.
double visibility(Random& random);

/// Sets the strength of effects[index] so that the gap it leaves, the others known in kind, is `target` times the floor.
void tune(Machine& machine, std::size_t index, double target);

/// Unmeasured torque or force: coloured, so strong that it stands above the sensors' noise.
void shake(Machine& machine, Random& random);

/// Lets the model err in the known quantity q until the gap is `target` times the floor, or by 2 to 15 percent; what it then believes.
double misbelieve(Machine model, const Truth& truth, std::size_t q, double target, Random& random);

}  // namespace algest::gap
