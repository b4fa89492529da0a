// SPDX-License-Identifier: GPL-3.0-or-later
// What templates say of a plan's elimination.
#pragma once
#include <string>
#include <vector>

#include "generator/plan.hpp"
#include "generator/render.hpp"

namespace algest::generator {

/// Sets `eliminates`, the elimination's arrays as C++ and their lengths. Numbers are hexadecimal.
void set_elimination(const plan::Plan& plan, Data& d);

/// One paragraph a stage, for the derivation; none without elimination.
std::vector<std::string> elimination_stages(const plan::Plan& plan);

}  // namespace algest::generator
