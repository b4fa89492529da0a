// SPDX-License-Identifier: GPL-3.0-or-later
// A hash of everything in a plan that numbers come from: a comment in a model file does not change it, a weight does.
#pragma once
#include <string>

#include "generator/plan.hpp"

namespace algest::generator {

/// 64-bit FNV-1a over a canonical serialisation, as 16 hexadecimal digits.
std::string plan_hash(const plan::Plan& plan);

}  // namespace algest::generator
