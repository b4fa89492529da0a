// SPDX-License-Identifier: GPL-3.0-or-later
// The library of physical effects, as data: models/effects/*.toml.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/model.hpp"
#include "lab/effect.hpp"

namespace algest::lab {

/// All effect files of the folders, by name; an effect of a later folder takes the place of one with its name. A file that is unsound,
/// and a second one of a folder with the same name, is an error in `diagnostics`.
std::vector<Effect> read_effects(const std::vector<std::string>& folders, Diagnostics& diagnostics);

/// What takes another's place in an equation.
struct Substitution {
    std::size_t equation;
    std::string what;         ///< a name, or a difference of two in parentheses
    std::string by;
    std::string derivative;   ///< of a signal: what takes the place of its der(), {derivative} standing for it; empty: it stays
    Part part = Part::everywhere;
    std::size_t state_set = 0;   ///< whose states stand in `by`
    std::map<std::string, std::string> roles = {};   ///< placeholders that stand in `by` and `derivative`; an amendment has filled them
};

/// A hidden state of one of several places that an effect enters at once.
struct BoundState {
    EffectState state;
    std::size_t state_set = 0;
    std::map<std::string, std::string> roles = {};   ///< placeholders that stand in its equation
};

/// One way in which an effect may enter a model.
struct Binding {
    const Effect* effect;
    std::vector<std::size_t> equations;             ///< indices into the model's equations
    std::vector<std::string> terms;                 ///< by equation: the effect's, placeholders still in it
    std::vector<std::map<std::string, std::string>> roles;   ///< by equation: placeholder -> formula, e.g. speed -> der(x)
    std::map<std::string, std::string> role_units;  ///< placeholder -> unit text
    std::string unit;                               ///< of the equation, as the effect spells it
    std::vector<Substitution> substitutions = {};
    std::vector<BoundState> states = {};
    std::string freed = {};                         ///< the constant that is let go
    std::set<std::size_t> beside = {};              ///< equations that an edit reaches which may do nothing there: rows of these do not judge the effect
    bool in_output = false;                         ///< it enters an equation that gives what a sensor shows
};

/// Every binding of an effect to a model whose signals are measured as said. An equation of unknown unit takes effects that fit
/// the unit of its leading term alone.
std::vector<Binding> bindings(const Effect& effect, const model::Model& model, const std::vector<bool>& measured);

}  // namespace algest::lab
