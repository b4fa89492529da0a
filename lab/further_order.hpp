// SPDX-License-Identifier: GPL-3.0-or-later
// Whether an effect that repeats over a signal does so at another number of times as well: a motor cogs at its slots, its poles, and multiples of them.
#pragma once
#include <optional>

#include "lab/effects.hpp"
#include "lab/screen.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// Of an amendment that `v` holds, the further value of its scan that stands highest above its neighbours: what it takes from the fitted rows is more than
/// chance makes in one search of a hundred. Nothing for an effect whose scan does not go in steps, or that has not two parameters.
std::optional<Candidate> further_order(const Workbench& bench, const Variant& v, const Amendment& held, const Effect& effect);

}  // namespace algest::lab
