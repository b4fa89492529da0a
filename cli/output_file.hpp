// SPDX-License-Identifier: GPL-3.0-or-later
// The file of -o must not take the place of what it is made from.
#pragma once
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"

namespace algest::cli {

/// True, with an error in `diagnostics`, if one of the outputs (empty: none) is a file that is read, or two of them are one file.
bool outputs_collide(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, Diagnostics& diagnostics);

}  // namespace algest::cli
