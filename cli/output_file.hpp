// SPDX-License-Identifier: GPL-3.0-or-later
// The file of -o must not take the place of what it is made from.
#pragma once
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"

namespace algest::cli {

/// True, with an error in `diagnostics`, if `output` (empty: none) is one of the files that are read.
bool output_is_input(const std::string& output, const std::vector<std::string>& inputs, Diagnostics& diagnostics);

}  // namespace algest::cli
