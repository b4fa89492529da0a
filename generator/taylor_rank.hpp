// SPDX-License-Identifier: GPL-3.0-or-later
// What the measured signals say near one instant: how their Taylor coefficients move with parameters and unknown initial values.
#pragma once
#include <optional>
#include <vector>

#include "generator/modular.hpp"
#include "generator/structural_form.hpp"

namespace algest::structure {

/// The gradients of the measured signals' Taylor coefficients at a random point, modulo a prime. Columns: the parameters, then everything else
/// that nobody knows (perturbations, initial values).
struct Sensitivity {
    modular::RowSpace rows;
    std::vector<modular::Vector> unknown_alone;   ///< the rows without the parameters' columns
    std::size_t columns = 0;
    modular::Vector point;   ///< values of the parameters there, then of the perturbations' coefficients
};

/// By the recursion of Sedoglavic (2002): the system and its sensitivities as power series, as many coefficients as there are unknowns and one
/// more. Functions of different arguments count as independent; a sgn() takes both of its values, each in a stretch of its own. Nullopt: no point
/// was found at which every square root exists. Cost: unknowns^3 operations for each operation of the equations.
std::optional<Sensitivity> sensitivity(const std::vector<Explicit>& equations, const std::vector<bool>& hidden, Symbols& symbols);

}  // namespace algest::structure
