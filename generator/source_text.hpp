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

/// The first place that no UTF-8 text has; nullopt if there is none.
std::optional<Position> not_utf8(const std::string& text);

/// The first TOML key of more than `limit` dotted parts; nullopt if there is none. The parser nests one table a part, and
/// would run out of stack when it frees them. Right up to the first error in the TOML.
std::optional<Position> too_long_key(const std::string& text, int limit);

/// The place itself, or the end of its line where it lies beyond: the parser's word for "the file ends here" may.
Position within_line(const std::string& text, Position at);
/// True at the end of a line and of the file.
bool at_line_end(const std::string& text, Position at);

/// For a TOML string whose token starts at `start`: the position of every byte of its value, and of its end. Knows all
/// four kinds of TOML strings, their escapes, and that CRLF is LF in a value. `value_size` is the size of the value in bytes.
std::vector<Position> places_of_string(const std::string& file_text, Position start, std::size_t value_size);

}  // namespace algest::model
