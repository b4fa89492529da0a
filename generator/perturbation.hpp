// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels that give the coefficients of the perturbation which the rows annihilate (the conclusion of 000 asks for them).
#pragma once
#include <vector>

#include "generator/exact.hpp"

namespace algest::perturbation {

/// With  sum theta_l der(f_l) = sum_(i=1..kappa) c_i t^(i-1)/(i-1)!  (000, equations 1 and 4), t from the window's oldest sample on, the rows with
/// kappa = 0 erase initial conditions and keep the perturbation: p = 1 .. kappa of them are linear in c_1 .. c_kappa with constant
/// coefficients. Solved exactly, they give one kernel per coefficient and derivative:
///     c_i T^(i-1) = sum theta_l T^-l integral of k_(i,l)(sigma) f_l(sigma)
/// The result is k_(i,l), lowest power of sigma first. 1 <= i <= kappa, l <= n. Cost: kappa^3 operations on rationals, kappa derivations.
std::vector<exact::Rational> kernel(int i, int l, int n, int kappa);

}  // namespace algest::perturbation
