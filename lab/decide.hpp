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

/// The first effect of a fitted set of which no parameter is three standard deviations from zero; nullptr: none. Only of terms without a scan: what bends the model,
/// or acts beyond a place, may be anything that is large enough, and a deviation says nothing of it; nor of what the data do not see (infinite).
const Amendment* may_be_nothing(const Variant& best);

/// Fits the nominal model, searches what it lacks by the free run, by rows where that drifts, and by the test stretch where noise is guessed and
/// nothing else speaks (foretold.hpp); then takes back a name that may be nothing, or that a plain law does without. `nominal` is left as it was fitted by the yardstick that
/// decided. declared: its parameters. Cost: three searches at the most.
Decision decide(Workbench& bench, Variant& nominal, const std::vector<double>& declared, const std::vector<Effect>& effects, const StepReport& progress);

}  // namespace algest::lab
