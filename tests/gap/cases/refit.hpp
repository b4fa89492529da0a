// SPDX-License-Identifier: GPL-3.0-or-later
// How large a gap is once the model's parameters did what they can: a least-squares fit in free run, by Gauss and Newton.
#pragma once
#include <functional>
#include <vector>

#include "run.hpp"

namespace algest::gap {

/// What the true machine did: scored signals without noise, and the sensor noise to measure errors in.
struct Truth {
    std::vector<std::vector<double>> outputs;
    std::vector<double> sigma;
    std::vector<std::vector<double>> inputs;
};

/// What the sensor of a signal shows, without noise.
std::vector<double> shown(const Machine& machine, const Run& run, std::size_t signal);

/// The same for all scored signals, in the order of the model's.
std::vector<std::vector<double>> scored(const Machine& machine, const Run& run);

struct Fitted {
    Machine model;
    std::vector<double> rms;  ///< by output: what is left, in sensor noises
    bool finite;
    double worst() const;
};

constexpr int to_the_end = 12;  ///< iterations: it ends where a step makes nothing smaller, mostly after four

/// Fits the unknown quantities and the strengths of the model's effects.
Fitted refit(Machine model, const Truth& truth, int iterations);

/// What would be left, worst output, if one thing more were free, to first order, for each of `nudges`, which moves that thing a little.
std::vector<double> left_with(const Fitted& fitted, const Truth& truth,
                              const std::vector<std::function<void(Machine&)>>& nudges);

}  // namespace algest::gap
