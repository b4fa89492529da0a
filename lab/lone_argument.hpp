// SPDX-License-Identifier: GPL-3.0-or-later
// Where a sgn() switches: at one value of one signal, or not.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "generator/model.hpp"

namespace algest::lab {

/// The argument of a sgn() that is affine in one signal that moves, or in one derivative of it, with numbers, constants and parameters.
struct LoneArgument {
    std::string switches_at;   ///< equal for arguments that pass zero together, where only numbers and constants are in them
    bool falls;                ///< it falls while the signal rises
};

/// nullopt: several moving or any replayed signal is in it, or it is not affine. moves: true for a signal that an equation moves.
std::optional<LoneArgument> lone_argument(const model::Model& model, const formula::Formula& argument, const std::function<bool(int)>& moves);

}  // namespace algest::lab
