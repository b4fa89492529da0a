// SPDX-License-Identifier: GPL-3.0-or-later
// A TOML file of format 1, opened: what every kind of file that algest reads has in common.
#pragma once
#include <functional>
#include <string>

#include "generator/toml_access.hpp"

namespace algest::model {

/// Largest file that is read, bytes.
constexpr std::size_t largest_file = 1024 * 1024;

/// Parses the text of a file and hands it to `read`; complains where it is no UTF-8, no TOML, or not of format 1. path: what
/// complaints name; see: where the reader finds what the file should be. False after a complaint made here or through the TomlAccess.
bool read_toml(const std::string& path, const std::string& text, const std::string& see, Diagnostics& diagnostics,
               const std::function<void(const toml::table& root, TomlAccess& file)>& read);

}  // namespace algest::model
