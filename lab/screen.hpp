// SPDX-License-Identifier: GPL-3.0-or-later
// Which effects the weak form of a model's equations speaks for: cheap, without a single free run.
#pragma once
#include <vector>

#include "lab/effects.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// An effect in a place, with the value of its scan that fits best.
struct Candidate {
    Binding binding;
    double scan;
    double strength;              ///< F statistic of the reduction of the weak residual, least over nothing: larger is likelier
    std::vector<double> start;    ///< parameters of the amended model, by the weak form of the equation that the effect enters
};

/// The most likely candidates beside what `base` already holds, best first, at most `most` and `most_of_one` of one effect.
/// Cost: one weak form a candidate, window length and scanned value.
std::vector<Candidate> screen(const Workbench& bench, const Variant& base, const std::vector<Effect>& effects, std::size_t most, std::size_t most_of_one);

}  // namespace algest::lab
