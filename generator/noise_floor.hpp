// SPDX-License-Identifier: GPL-3.0-or-later
// What the declared noise alone may make of S(t): a machine that stands still must not pass for one that is excited.
#pragma once
#include <vector>

#include "generator/plan.hpp"

namespace algest::generator {

/// S(t) must see every combination of the unknowns with this many times the square of what noise puts there. S(t) spans a few windows that do not
/// overlap, so that noise alone scatters like chi squared with few degrees of freedom: 16 times its mean is rare. What passes is biased by noisy
/// regressors by 1/16 at most. Rows of operating points and of z and q likewise: on the motor of 002 at one current the wrong minimum stands below 6
/// times what noise makes of it, the right one of four currents above 70.
constexpr double floor_over_noise = 16.0;

/// Packed upper triangle of the unknowns: floor_over_noise times the mean of S(t) where all signals are noise. Noise that enters by a partial
/// derivative that changes is left out, for its size is not known here: the floor is then too low, never too high. Empty unless the plan is
/// robust, with windows, weights and noise in a regressor. Cost: rows x noisy inputs x samples x unknowns^2.
std::vector<double> noise_floor(const plan::Plan& plan);

/// Of each row of a plan in z or q: the mean of dP'dP where the output is white noise of deviation 1, packed upper triangle of the unknowns. The input
/// counts as known. Empty without weights. Cost: rows x samples x unknowns^2 / 2.
std::vector<double> noise_of_rows(const plan::Plan& plan);

}  // namespace algest::generator
