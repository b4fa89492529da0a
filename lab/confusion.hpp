// SPDX-License-Identifier: GPL-3.0-or-later
// What a recording cannot tell apart, in words.
#pragma once
#include <string>
#include <vector>

#include "generator/plan.hpp"
#include "lab/stacked_rows.hpp"

namespace algest::lab {

/// Unknowns that the recording cannot tell apart, or hardly, in words: which, why, and what is determined instead.
struct Confusion {
    bool hardly;                              ///< they have values, with large deviations
    std::vector<std::string> unknowns;
    std::string text;
};

/// Belsley, Kuh, Welsch: columns of norm 1 whose condition is above 30 nearly depend on each other.
constexpr double dependent_columns = 30.0;

/// What an unknown multiplies, in the first row that has it: "omega", "der(i) + ...".
std::string regressor(const plan::Plan& plan, Eigen::Index unknown);

/// One for each direction that is undetermined, in as few unknowns as may be, then one for each that is hardly determined. of_solution: covariance().
/// Cost: unknowns^3.
std::vector<Confusion> confusions(const plan::Plan& plan, const Decomposition& d, const Eigen::MatrixXd& of_solution);

/// An entry of an undetermined direction below this is rounding and noise: what it stands for is determined.
constexpr double negligible = 1e-2;

}  // namespace algest::lab
