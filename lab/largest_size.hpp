// SPDX-License-Identifier: GPL-3.0-or-later
// How large what stands for a role becomes: what a scanned range is counted in.
#pragma once
#include <string>

#include "lab/simulate.hpp"

namespace algest::lab {

/// Largest absolute value on the recording of a signal, of der() of one, or of a difference of two in parentheses; 1 where it is not measured.
double largest_size(const std::string& formula, const model::Model& model, const Bench& bench);

}  // namespace algest::lab
