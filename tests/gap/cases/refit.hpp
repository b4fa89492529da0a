// SPDX-License-Identifier: GPL-3.0-or-later
// How large a gap is once the model's parameters did what they can: a least-squares fit in free run, by Gauss and Newton.
#pragma once
#include <vector>

#include "run.hpp"

namespace algest::gap {

/// What the true machine did: scored signals without noise, and the sensor noise to measure errors in.
struct Truth {
    std::vector<std::vector<double>> outputs;
    std::vector<double> sigma;
    std::vector<std::vector<double>> inputs;
};

/// Scored signals of a run, in the order of the model's signals.
std::vector<std::vector<double>> scored(const System& system, const Run& run);

struct Fitted {
    Machine model;
    std::vector<double> rms;   ///< by output: what is left, in sensor noises
    bool finite;
    double worst() const;
};

/// Fits the unknown quantities and the strengths of the model's effects.
Fitted refit(Machine model, const Truth& truth, int iterations);

/// What would be left if one more effect were fitted beside all that is free in `fitted`, to first order; its strength sets the step.
double left_with(const Fitted& fitted, const Truth& truth, const Effect& rival);

}  // namespace algest::gap
