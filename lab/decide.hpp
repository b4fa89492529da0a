// SPDX-License-Identifier: GPL-3.0-or-later
// What the training stretch says: which effects, by which yardstick, and whether a law is left that none of them is.
#pragma once
#include <string>
#include <vector>

#include "lab/selection.hpp"

namespace algest::lab {

struct Decision {
    Selection selection;
    Verdict verdict;
    std::vector<std::string> against;   ///< a sentence each on why nothing is named: a strength that may be zero; a plain law beside what was chosen, or in its place
};

bool names_something(Verdict verdict);

/// Fits the nominal model, searches what it lacks by the free run, by rows where that drifts, and by the test stretch where noise is guessed and
/// nothing else speaks (foretold.hpp); then holds nothing, and plain laws, against what was found. `nominal` is left as it was fitted by the yardstick that
/// decided. declared: its parameters. Cost: three searches at the most.
Decision decide(Workbench& bench, Variant& nominal, const std::vector<double>& declared, const std::vector<Effect>& effects, const StepReport& progress);

}  // namespace algest::lab
