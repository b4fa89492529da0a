// SPDX-License-Identifier: GPL-3.0-or-later
// Whether an effect that repeats over a signal does so at another number of times as well: a motor cogs at its slots, its poles, and multiples of them.
#pragma once
#include <optional>

#include "lab/effects.hpp"
#include "lab/screen.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// The strongest further value of the scan of an amendment that `v` holds, where what that takes from the rows of the training stretch stands above
/// what its neighbours take, by more than chance in one search of a hundred; its strength is the ratio. Nothing for an effect whose scan does not go in steps.
std::optional<Candidate> further_order(const Workbench& bench, const Variant& v, const Amendment& held, const Effect& effect);

}  // namespace algest::lab
