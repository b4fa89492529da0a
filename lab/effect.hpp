// SPDX-License-Identifier: GPL-3.0-or-later
// A physical effect, as its file says it (models/effects/*.toml; every key: docs/discover.md).
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"

namespace algest::lab {

/// What an effect does to a model (design.md, section 6).
enum class Rewrite { add_term, replace, transform_signal, add_state, free_constant };

/// A parameter that an effect brings; `{equation}` and `{role}` in the unit stand for the units of what they are bound to.
struct EffectParameter {
    std::string name;
    std::string unit;
    std::optional<double> min;
    std::string neutral = {};   ///< the value at which the effect does nothing: a number, or a {role} that is a parameter or constant; empty: 0
};

/// A number that is scanned, since the term is not linear in it.
struct EffectScan {
    std::string name;
    std::string unit;
    double from;
    double to;
    double step;             ///< to the next value; 0: `factor` instead
    bool spectrum;           ///< instead: the strongest lines of the residual's spectrum, in rad/s
    double factor = 0;       ///< from each value to the next
    std::string of = {};     ///< from and to are multiples of: the largest size of what stands for this role, "period" or "duration"; empty: 1
    bool fitted = false;     ///< the scan gives the start, the free run the value
};

/// Which equations an edit is made in, seen from the one that the effect enters.
enum class Reach { own, all, fed, d, q, torque };   ///< fed: others that move something and have the signal that it moves in them; there may be none

/// Which places of a name an edit is made at.
enum class Part { everywhere, leading, elsewhere };

/// One change of an equation's text; {roles} stand in it.
struct EffectEdit {
    Reach in = Reach::own;
    std::string add;          ///< a term that comes beside the driving ones, with its sign; else
    std::string what;         ///< role of what is replaced
    std::string by;           ///< what comes in its place
    std::string derivative;   ///< what comes in the place of der() of a signal, {derivative} standing for it; empty: it stays
    Part part = Part::everywhere;
};

/// A hidden state that an effect brings, and the equation that moves it.
struct EffectState {
    std::string name;
    std::string unit;
    double initial;
    std::string ode;
};

struct Rival {
    std::string name;
    std::string experiment;   ///< that tells the two apart
    bool first = false;       ///< it is the plainer account: it is named where both explain alike
};

struct Effect {
    std::string name;
    Position at;                                 ///< of the name
    std::vector<std::string> aliases;
    std::string summary;
    std::string shows;
    std::string reference;
    std::vector<std::string> units;              ///< of equations that it may enter
    bool together = false;                       ///< it enters all equations of that unit at once, with one value
    std::map<std::string, std::string> roles;    ///< placeholder -> kind (lab/roles.hpp)
    Rewrite rewrite = Rewrite::add_term;
    std::string freed;                           ///< role of the constant that is let go
    std::vector<EffectEdit> edits;
    std::vector<EffectState> states;
    std::string term;                            ///< with placeholders, as it is added beside the driving terms
    std::string d_term;                          ///< in the d equation of a rotating frame, {d} {q} {angle} standing for currents and
    std::string q_term;                          ///< electrical angle; empty: as any other equation
    std::vector<EffectParameter> parameters;
    std::vector<EffectScan> scans;               ///< at most one
    std::vector<Rival> rivals;
    bool outside = false;                        ///< it hangs on nothing in the model: no rival of an effect that does

    /// It bends what the model has instead of adding to it, and fits much.
    bool flexible() const { return rewrite == Rewrite::transform_signal || rewrite == Rewrite::add_state || rewrite == Rewrite::free_constant; }
};

}  // namespace algest::lab
