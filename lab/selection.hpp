// SPDX-License-Identifier: GPL-3.0-or-later
// The choice of effects: forward by free-run error on the validation rows, with replacement, then pruning.
#pragma once
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lab/discovery.hpp"
#include "lab/effects.hpp"
#include "lab/screen.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// What is going on, in words, with a share of the work done.
using StepReport = std::function<void(const std::string&, double)>;

/// A set of effects that was fitted, and the rows of the evidence that led there.
struct Tried {
    Variant variant;
    std::vector<std::size_t> evidence;
};

struct Selection {
    Variant best;                       ///< the nominal model itself where nothing was worth adding
    std::vector<Variant> rivals;        ///< that the validation rows do not tell from it
    std::vector<Evidence> evidence;
    bool cut_short;                     ///< the effort of the bench, or a candidate's share of it, was used up before everything was tried
    std::vector<std::string> as_well = {};   ///< doubts: what explains as much as what was chosen, and is the less plain account
    std::vector<Tried> tried = {};      ///< every set that was fitted
};

/// `base` with one more effect, fitted and scored; nullopt: with it the text is no model. Cost: one fit, up to four where it goes astray, within a candidate's share.
std::optional<Variant> with_candidate(Workbench& bench, const Variant& base, const Candidate& c);

/// What tells a set of effects from another one.
std::set<std::string> identities(const Variant& v);

/// True when a is so much nearer than b that adding something to b is worth it: its error surely below `gain` times b's.
bool worth_it(const Score& a, const Score& b, double gain);

/// Searches until the gap is at the floor, nothing is worth adding, three effects stand, or the effort of the bench is used up.
Selection select_effects(Workbench& bench, const Variant& nominal, const std::vector<Effect>& effects, const StepReport& progress);

}  // namespace algest::lab
