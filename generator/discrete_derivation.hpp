// SPDX-License-Identifier: GPL-3.0-or-later
// The derivation of a discrete-time estimator (004), as derivation.cpp gives it of the others. The plan must have `discrete`.
#pragma once
#include <string>

#include "generator/plan.hpp"

namespace algest::generator {

/// For a person, for a paper, for a program. solve_text: how the rows are solved, in words.
std::string discrete_derivation_text(const plan::Plan& plan, const std::string& solve_text);
std::string discrete_derivation_latex(const plan::Plan& plan);
std::string discrete_derivation_json(const plan::Plan& plan, const std::string& solve_text, bool weights);

}  // namespace algest::generator
