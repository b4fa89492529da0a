// SPDX-License-Identifier: GPL-3.0-or-later
// Which parameters single precision cannot hold, and by how much it misses them.
#pragma once
#include <string>
#include <vector>

#include "generator/kernel.hpp"
#include "generator/lumping.hpp"
#include "generator/model.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// How much larger the numbers are that a kernel takes the difference of than that difference: the integral of |K| over that of K sigma^d, where
/// sigma^d is the first power that the kernel does not annihilate, the slowest signal that it sees. At least 1; 0 for a kernel of zeros.
/// Midpoint rule, half a percent off at most for the orders that rows have. Cost: 256 values.
exact::Rational cancellation(const kernel::Coefficients& of);

/// A sentence for each equation of a plan in single precision whose rounding may move an estimate by more than 2 percent before its condition
/// refuses it, with the parameters that the equation determines; none for the others. Rounding moves a solution by about unit roundoff times
/// condition times the cancellation of its rows, S(t), a product of rows, by the condition's square in place of the condition.
std::vector<std::string> single_precision_notes(const model::Model& model, const lumping::Lumping& lumping, const plan::Plan& plan);

}  // namespace algest::generator
