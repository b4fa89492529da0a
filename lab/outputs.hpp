// SPDX-License-Identifier: GPL-3.0-or-later
// Output equations: y = formula says what a sensor shows of a machine that other equations move.
#pragma once
#include <optional>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/model.hpp"

namespace algest::lab {

/// The signal (index into the model's) that an equation gives as an output: it stands alone on the left, and nothing is differentiated.
/// -1: the equation is another one.
int output_of(const model::Model& model, const model::Equation& equation);

/// True when an output equation gives the signal.
bool is_output(const model::Model& model, int signal);

/// The output equations (indices into the model's) in an order in which each finds what it needs. Complains, and nullopt, where one gives
/// what an equation moves, a law sets or another one gives, where they need themselves, or where an equation of motion sees an output: what
/// moves does not hang on what a sensor shows.
std::optional<std::vector<std::size_t>> output_order(const model::Model& model, Diagnostics& diagnostics);

}  // namespace algest::lab
