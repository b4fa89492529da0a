// SPDX-License-Identifier: GPL-3.0-or-later
// Combinations of parameters that measured signals determine where the parameters themselves are open.
#pragma once
#include <vector>

#include "generator/modular.hpp"
#include "generator/polynomial.hpp"

namespace algest::structure {

/// Simple ones first: products, quotients and sums of two or three of `open` (indices of variables); then `others`. `known`: what the signals
/// determine (true: a gradient lies in the space); its first columns are the parameters. At most `count`, independent of each other and of the
/// parameters that are not open.
std::vector<Quotient> combinations(const std::vector<int>& open, const std::vector<Quotient>& others, std::size_t count, const modular::RowSpace& known,
                                   std::size_t columns, const modular::Vector& point);

}  // namespace algest::structure
