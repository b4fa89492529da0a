// SPDX-License-Identifier: GPL-3.0-or-later
// A hidden effect: what it adds to the true machine, or does to an input or a sensor, as code for the simulation and as text for the
// check against algest.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "system.hpp"

namespace algest::gap {

struct Effect {
    std::string name;
    std::vector<std::string> accepted;  ///< names that count as right
    std::string formula;                ///< for answer.json
    std::vector<std::string> names;     ///< of its parameters; the first one is its strength
    std::vector<double> values;
    std::vector<int> slots;  ///< of the system
    State own;               ///< states of its own, at their initial values
    bool in_library = true;  ///< no usual library holds it: the right answer is `unknown`
    double strength_sign = 1;
    double most = 0;    ///< the strength that nobody would overlook, if there is such a bound
    bool tuned = true;  ///< its strength may be set for a wanted gap; else it stays as drawn

    /// The term in slots[which], as it stands on the right side.
    std::function<double(std::size_t which, const double* x, const double* u, double t, const double* own, const double* q)>
        term;
    std::function<void(const double* x, const double* u, const double* own, const double* q, double* rate)> own_rate;
    /// What becomes of inputs[which] on its way, from all commands up to sample k.
    std::vector<int> inputs;
    std::function<double(std::size_t which, const std::vector<std::vector<double>>& commanded, std::size_t k,
                         const double* own, const double* q)>
        arrives;
    /// What `signal` (index into the system's) shows of a value.
    int signal = -1;
    std::function<double(double value, const double* q)> shows;

    /// The same in the model's language, where `x_NAME` are its parameters; further lines for its own states.
    std::vector<std::string> texts;
    std::vector<std::string> own_signals, own_equations;
    std::vector<std::string>
        input_texts;  ///< stand for the inputs in all equations; none: only a changed recording can show it

    std::string where;  ///< for answer.json where `slots` does not say it
    /// The parameters as the answer states them, where they are not `values`.
    std::function<std::vector<std::pair<std::string, double>>(const std::vector<double>& values)> stated;

    std::string equations(const System& system) const;  ///< signals of the equations it enters, with commas
};

/// The effect of that name in that slot, at a strength of a tenth of the slot's size (to be tuned); nullopt where it does not belong.
/// `scale` holds the typical sizes of the states: sgn is tanh(x/eps) with eps a small share of it.
std::optional<Effect> effect(const std::string& name, const System& system, int slot, const State& scale, Random& random);

/// An effect that is more than a term: of a slot, an input or a signal, whichever `index` counts for that name.
std::optional<Effect> structural_effect(const std::string& name, const System& system, int index, const State& scale,
                                        Random& random);

/// The names of those, and how many indices may be tried.
const std::vector<std::string>& structural_effects();

/// The names of effects that a usual library holds and that are a term.
const std::vector<std::string>& term_effects();

/// Dead time of three half bridges, in d-q coordinates.
Effect three_phase_dead_time(const System& system, const State& scale);

constexpr double smoothing = 3e-4;  ///< eps of tanh(x/eps), as a share of the signal's size

}  // namespace algest::gap
