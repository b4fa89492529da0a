// SPDX-License-Identifier: GPL-3.0-or-later
// The edits of an effect, once its roles are known: which names are replaced in which equations.
#pragma once
#include <vector>

#include "lab/effects.hpp"
#include "lab/equation_places.hpp"

namespace algest::lab {

/// Fills in substitutions, states, terms by equation and the constant that is let go, from an effect whose roles are bound; the binding's one
/// equation becomes those that it is said to enter. False where the model has no place for them.
bool bind_edits(Binding& binding, const model::Model& model, const std::vector<bool>& measured);

/// True when one of these does the same to the model: a difference, an input or a constant is found from each equation that it stands in.
bool is_bound_already(const Binding& binding, const std::vector<Binding>& others);

/// The places of a substitution in its equation, those of der() last.
struct Places {
    std::vector<Stretch> plain;
    std::vector<Stretch> derivatives;
};
Places places_of(const Substitution& substitution, const model::Model& model);

}  // namespace algest::lab
