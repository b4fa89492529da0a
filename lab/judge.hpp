// SPDX-License-Identifier: GPL-3.0-or-later
// What may be said of a selection: the verdict, and what a reader should doubt.
#pragma once
#include <string>
#include <vector>

#include "lab/discovery.hpp"
#include "lab/selection.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// What the floor of a gap is worth as a bar. Where no noise is declared it is a guess: an effect that takes most of the gap away is then named
/// though more than that floor is left.
enum class Floor { known, a_guess };

Verdict judge(const Workbench& bench, const Variant& nominal, const Selection& selection, Floor floor = Floor::known);

/// A sentence for each thing that a reader should not take for granted.
std::vector<std::string> doubts(const Workbench& bench, const Variant& nominal, const Selection& selection, Verdict verdict);

/// False, and errors in `diagnostics`, where a recording cannot show a gap: an output that never moves, or that stays within its noise.
bool excited(const Workbench& bench, const Variant& nominal, Diagnostics& diagnostics);

}  // namespace algest::lab
