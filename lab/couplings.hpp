// SPDX-License-Identifier: GPL-3.0-or-later
// What acts between two bodies: the friction of a strut, the spring of a shaft. It acts on both of them, on one against the other.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "lab/effects.hpp"

namespace algest::lab {

/// Bindings of an added term that hangs on a motion alone to every two bodies whose equations share the difference of their positions or speeds:
/// the term of that difference in the first, its opposite in the second. Both have to be balances of forces or
/// torques as they are written. unit_of: as `bindings` has it, nullopt where the effect may not enter.
std::vector<Binding> bindings_between_bodies(const Effect& effect, const model::Model& model, const std::vector<bool>& measured,
                                             const std::vector<std::optional<std::string>>& unit_of);

}  // namespace algest::lab
