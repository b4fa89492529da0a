// SPDX-License-Identifier: GPL-3.0-or-later
// A hidden effect: terms that it adds to the true machine, as code for the simulation and as text for the check against algest.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "system.hpp"

namespace algest::gap {

struct Effect {
    std::string name;
    std::vector<std::string> accepted;   ///< names that count as right
    std::string formula;                 ///< for answer.json
    std::vector<std::string> names;      ///< of its parameters; the first one is its strength
    std::vector<double> values;
    std::vector<int> slots;              ///< of the system
    State own;                           ///< states of its own, at their initial values
    bool in_library = true;              ///< no usual library holds it: the right answer is `unknown`
    double strength_sign = 1;

    /// The term in slots[which], as it stands on the right side.
    std::function<double(std::size_t which, const double* x, const double* u, double t, const double* own, const double* q)> term;
    std::function<void(const double* x, const double* own, const double* q, double* rate)> own_rate;

    /// The same in the model's language, where `x_NAME` are its parameters; further lines for its own states.
    std::vector<std::string> texts;
    std::vector<std::string> own_signals, own_equations;

    std::string equations(const System& system) const;   ///< signals of the equations it enters, with commas
};

/// The effect of that name in that slot, at a strength of a tenth of the slot's size (to be tuned); nullopt where it does not belong.
/// `scale` holds the typical sizes of the states: sgn is tanh(x/eps) with eps a small share of it.
std::optional<Effect> effect(const std::string& name, const System& system, int slot, const State& scale, Random& random);

/// The names of effects that a usual library holds and that are a term.
const std::vector<std::string>& term_effects();

/// Dead time of three half bridges, in d-q coordinates.
Effect three_phase_dead_time(const System& system, const State& scale);

constexpr double smoothing = 3e-4;   ///< eps of tanh(x/eps), as a share of the signal's size

}  // namespace algest::gap
