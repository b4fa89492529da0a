// SPDX-License-Identifier: GPL-3.0-or-later
// Names where they stand in a formula as a whole: `R` in "R*i", not in "R_s*i".
#pragma once
#include <cstddef>
#include <string>

namespace algest::lab {

/// Where the name stands as a whole word, at `from` or behind it; npos: nowhere.
std::size_t find_whole_word(const std::string& text, const std::string& name, std::size_t from = 0);

}  // namespace algest::lab
