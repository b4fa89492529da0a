// SPDX-License-Identifier: GPL-3.0-or-later
// The last word where noise is guessed and the validation rows speak for nothing: the unseen test stretch.
#pragma once
#include "lab/selection.hpp"

namespace algest::lab {

/// Where nothing was chosen: chooses the set of effects that explains the whole training stretch best, if it foretells the test stretch as
/// well. An effect that acts in the fitted rows alone bends the other parameters, and the rows behind them do not show it. Each effect has to
/// halve the squared error of the training stretch, and the set that of the test stretch, which is asked once, for one set. What the training
/// stretch does not tell from it becomes its rival. True: it chose.
/// Cost: a run of every set that was tried, and a last fit of the best few.
bool choose_what_foretells(Workbench& bench, const Variant& nominal, Selection& selection);

}  // namespace algest::lab
