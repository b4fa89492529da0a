// SPDX-License-Identifier: GPL-3.0-or-later
// From physical parameters to unknowns in which the rows are linear, and back: the exact inverse map.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generator/equation.hpp"

namespace algest::lumping {

/// coefficient of one term of an equation: known + sum of factor * unknown.
struct LumpedTerm {
    int term;                                            ///< index into the operator form's terms
    exact::Rational known;
    std::vector<std::pair<int, exact::Rational>> unknown;   ///< index into Lumping::unknowns, factor
};

/// over: the coefficient as a combination of what is known and the unknowns, in that order.
LumpedTerm lumped_term(int term, const std::vector<exact::Rational>& over);

/// An unknown of the rows.
struct Unknown {
    std::string name;       ///< Gamma1, Gamma2, ...; a parameter's own name where it is that parameter
    Quotient meaning;       ///< in the model's parameters
    int component;          ///< equations and unknowns that belong together
};

struct LumpedEquation {
    bool used;              ///< false: it has no unknowns and serves simulation
    bool divided;           ///< by the coefficient `leading`
    Quotient leading;
    int component;
    std::vector<LumpedTerm> terms;   ///< those that the rows keep: kappa >= 1 erases constants
};

struct Lumping {
    std::vector<Unknown> unknowns;
    std::vector<LumpedEquation> equations;            ///< as the model's
    std::vector<std::optional<Quotient>> inverse;     ///< of the model's parameters, in the unknowns
    std::optional<plan::Elimination> elimination = {};   ///< instead: the inverse of parameters that it gives is themselves
};

/// Chooses per group of equations that share parameters: as written where that needs fewer unknowns than after division by the
/// leading coefficient, divided otherwise (000 divides). Complains where no data tell parameters apart (not identifiable), also
/// because an equation without parameters ties signals together; where more unknowns than parameters remain or the map has no
/// rational inverse (bad input). With solve = "elimination" as constrained_lumping.hpp says.
std::optional<Lumping> lump(const model::Model& model, const std::vector<equation::OperatorForm>& forms, Diagnostics& diagnostics);

}  // namespace algest::lumping
