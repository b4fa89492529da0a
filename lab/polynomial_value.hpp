// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials in a model's parameters, and their slopes, in floating point.
#pragma once
#include <vector>

#include "generator/polynomial.hpp"

namespace algest::lab {

double value_of(const Polynomial& p, const std::vector<double>& parameters);

/// d/d(parameter k).
double slope_of(const Polynomial& p, const std::vector<double>& parameters, std::size_t k);

}  // namespace algest::lab
