// SPDX-License-Identifier: GPL-3.0-or-later
// Calls of delay() in formulas: which signal, by how much.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"

namespace algest::model {

struct Delay {
    std::string text;              ///< of the call: equal ones have one
    formula::Formula call;
    int signal;                    ///< index into the model's signals
    std::optional<Rational> by;    ///< s; empty where a parameter says it
    int parameter;                 ///< index into the model's parameters; -1: none
};

/// Adds the delays of a formula that was read without complaint to `out`, in the order of the text, each once.
void add_delays(const Model& model, const formula::Formula& f, std::vector<Delay>& out);

}  // namespace algest::model
