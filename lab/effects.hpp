// SPDX-License-Identifier: GPL-3.0-or-later
// The library of physical effects, as data: models/effects/*.toml.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/model.hpp"

namespace algest::lab {

/// A parameter that an effect brings; `{equation}` and `{role}` in the unit stand for the units of what they are bound to.
struct EffectParameter {
    std::string name;
    std::string unit;
    bool not_negative;
};

/// A number that is scanned, since the term is not linear in it.
struct EffectScan {
    std::string name;
    std::string unit;
    double from;
    double to;
    double step;
    bool spectrum;   ///< instead: the strongest lines of the residual's spectrum, in rad/s
};

struct Rival {
    std::string name;
    std::string experiment;   ///< that tells the two apart
};

struct Effect {
    std::string name;
    std::vector<std::string> aliases;
    std::string summary;
    std::string shows;
    std::string reference;
    std::vector<std::string> units;              ///< of equations that it may enter
    bool together;                               ///< it enters all equations of that unit at once, with one value
    std::map<std::string, std::string> roles;    ///< placeholder -> kind: speed, angle, position, own, current, any_speed, input, time (docs/discover.md)
    std::string term;                            ///< with placeholders, as it is added beside the driving terms
    std::string d_term;                          ///< in the d equation of a rotating frame, {d} {q} {angle} standing for currents and
    std::string q_term;                          ///< electrical angle; empty: as any other equation
    std::vector<EffectParameter> parameters;
    std::vector<EffectScan> scans;               ///< at most one
    std::vector<Rival> rivals;
    bool outside;                                ///< it hangs on nothing in the model: no rival of an effect that does
};

/// All effect files of the folders, by name; a file that is unsound is an error in `diagnostics`.
std::vector<Effect> read_effects(const std::vector<std::string>& folders, Diagnostics& diagnostics);

/// One way in which an effect may enter a model.
struct Binding {
    const Effect* effect;
    std::vector<std::size_t> equations;             ///< indices into the model's equations
    std::vector<std::string> terms;                 ///< by equation: the effect's, placeholders still in it
    std::vector<std::map<std::string, std::string>> roles;   ///< by equation: placeholder -> formula, e.g. speed -> der(x)
    std::map<std::string, std::string> role_units;  ///< placeholder -> unit text
    std::string unit;                               ///< of the equation, as the effect spells it
};

/// Every binding of an effect to a model whose signals are measured as said. An equation of unknown unit takes effects that fit
/// the unit of its leading term alone.
std::vector<Binding> bindings(const Effect& effect, const model::Model& model, const std::vector<bool>& measured);

}  // namespace algest::lab
