// SPDX-License-Identifier: GPL-3.0-or-later
// A text file in memory, and where the characters of a TOML string stand in it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"

namespace algest::model {

/// Reads a whole file of at most `limit` bytes; one complaint and nullopt if it cannot be read, is no file, or is larger.
std::optional<std::string> read_text(const std::string& path, std::size_t limit, Diagnostics& diagnostics);

/// For a TOML string whose token starts at `start`: the position of every byte of its value, and of its end. Knows all
/// four kinds of TOML strings and their escapes. `value_size` is the size of the value in bytes.
std::vector<Position> places_of_string(const std::string& file_text, Position start, std::size_t value_size);

}  // namespace algest::model
