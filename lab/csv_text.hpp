// SPDX-License-Identifier: GPL-3.0-or-later
// The pieces of a CSV that is written: headers with units, numbers with the shortest digits that read back.
#pragma once
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string>

namespace algest::lab {

/// A field of a header: in quotes where a comma or quote in it asks for them.
std::string csv_field(const std::string& text);

/// "NAME [unit]", or "NAME" where no unit is declared.
std::string csv_heading(const std::string& name, const std::string& unit);

/// Shortest digits that read back to the same value in S; nothing for what is not finite.
template <class S>
void append_number(std::string& out, double value) {
    if (std::isfinite(value)) fmt::format_to(std::back_inserter(out), "{}", static_cast<S>(value));
}

}  // namespace algest::lab
