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
    std::string why;                          ///< which, and what stands still or moves alike
    std::string determined;                   ///< what is known instead, with its value; empty where that is nothing
    Eigen::Index direction;                   ///< which singular vector; -1: of several that are undetermined

    std::string text() const { return determined.empty() ? why : why + "; " + determined; }
};

/// Belsley, Kuh, Welsch: columns of norm 1 whose condition is above 30 nearly depend on each other.
constexpr double dependent_columns = 30.0;

/// What an unknown multiplies, in the first row that has it: "omega", "-u", "der(i) + ...".
std::string regressor(const plan::Plan& plan, Eigen::Index unknown);

/// A single signal with a minus is that signal, and its factor takes the sign.
std::string without_its_sign(const std::string& regressor, double& factor);

/// One for each direction that is undetermined, in as few unknowns as may be, then one for each that is hardly determined. of_solution: covariance().
/// Cost: unknowns^3.
std::vector<Confusion> confusions(const plan::Plan& plan, const Decomposition& d, const Eigen::MatrixXd& of_solution);

/// An entry of an undetermined direction below this is rounding and noise: what it stands for is determined.
constexpr double negligible = 1e-2;

}  // namespace algest::lab
