// SPDX-License-Identifier: GPL-3.0-or-later
// What an estimator of operating points saw, what an elimination chose from, and what the data lack where they tell nothing.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "algest/elimination.hpp"
#include "generator/plan.hpp"

namespace algest::lab {

/// The means of every operating point, point after point: one number per plan.steady->averaged.
struct OperatingPoints {
    std::vector<double> means;
    std::size_t quantities = 0;
    std::size_t count() const { return quantities == 0 ? 0 : means.size() / quantities; }
    double at(std::size_t point, std::size_t quantity) const { return means[point * quantities + quantity]; }
};

/// A candidate of an elimination in the parameters' units.
struct EliminationCandidate {
    struct Value {
        std::string name;   ///< "L", or "K^2" where it enters by its square alone
        double value;
    };
    std::string equations;
    std::vector<Value> values;
    double error;           ///< sum of squared residuals, weighted as the rows are
    Standing standing;
};

/// For programs: best, extremum, unreal, spurious.
const char* name(Standing standing);

/// For people: "the estimate", "an extremum with a larger error", ...
const char* in_words(Standing standing);

/// The runtime's candidates with names, units and true sizes; the best first, spurious ones last, else in order of their errors.
std::vector<EliminationCandidate> named_candidates(const plan::Plan& plan, const std::vector<Candidate<double>>& candidates);

/// Why operating points do not determine the parameters: there is none, or a quantity is the same at all of them. Empty: they do, or the plan has
/// none. ok: an estimate followed from them.
std::optional<std::string> what_is_missing(const plan::Plan& plan, const OperatingPoints& points, bool ok);

}  // namespace algest::lab
