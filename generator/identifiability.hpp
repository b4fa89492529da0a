// SPDX-License-Identifier: GPL-3.0-or-later
// Which parameters no data can tell apart: the rank of what the equations' coefficients do as the parameters move.
#pragma once
#include <string>
#include <vector>

#include "generator/equation.hpp"

namespace algest::lumping {

/// Equations that share parameters, and those parameters.
struct Component {
    std::vector<int> equations;
    std::vector<int> parameters;
};

/// True when the rows of the equation see the term: kappa >= 1 erases constants.
bool kept(const model::Equation& equation, const equation::OperatorForm& form, const equation::Term& term);

/// True when no coefficient has a parameter: such an equation ties signals together.
bool without_parameters(const equation::OperatorForm& form);

/// Values of so many parameters (primes over 7) at which things are what they are almost everywhere.
std::vector<exact::Rational> generic_point(std::size_t parameters);

/// The parameters that no data determine, how many of them would have to be known, and a choice of so many that determines the others: not every one does.
struct Undetermined {
    std::size_t missing;
    std::vector<int> parameters;
    std::vector<int> enough;
};

/// "one of R, J", "2 of R, J, K, e.g. R and J".
std::string choice(const Undetermined& open, const std::vector<std::string>& names);

/// The equations hold at other values too where each of their coefficients moves by its derivatives as much as a factor on
/// its equation, or with `tied` a multiple of an equation without parameters, would move it: what the rank of derivatives
/// lacks beside these columns. b/a, c/a and c/b are three unknowns, and leave one of three parameters open.
/// Exact, at the generic point. Cost: a rank, and up to three more for each parameter where some are missing.
Undetermined undetermined(const model::Model& model, const std::vector<equation::OperatorForm>& forms, const Component& component, bool tied);

}  // namespace algest::lumping
