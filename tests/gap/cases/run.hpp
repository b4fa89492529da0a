// SPDX-License-Identifier: GPL-3.0-or-later
// The machine in motion: integrates a system with hidden effects, tightly, as experiment or as replay.
#pragma once
#include <vector>

#include "effect.hpp"
#include "system.hpp"

namespace algest::gap {

/// A machine: the system with values of its quantities and effects.
struct Machine {
    const System* system;
    std::vector<double> p;  ///< by quantity
    std::vector<Effect> effects;
    State scale;                                          ///< typical sizes of the states, for the tolerance
    std::vector<std::vector<double>> process_noise = {};  ///< by slot: one value a sample, held; empty: none
};

/// By sample. Not finite: the run diverged.
struct Run {
    std::vector<State> states;
    std::vector<std::vector<double>> inputs;
    bool finite = true;
};

/// The experiment: the system's controller sets the inputs, rounded as the recording holds them.
Run record(const Machine& machine);

/// The same from recorded inputs; the input of a feedback law is computed anew.
Run replay(const Machine& machine, const std::vector<std::vector<double>>& inputs);

}  // namespace algest::gap
