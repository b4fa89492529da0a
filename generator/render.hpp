// SPDX-License-Identifier: GPL-3.0-or-later
// Templates -> text. A name that a template asks for and is not given is an error, not an empty string.
#pragma once
#include <kainjow/mustache.hpp>

#include <string>

namespace algest::generator {

using Data = kainjow::mustache::data;
using DataList = kainjow::mustache::list;

/// Renders templates/PATH. Throws std::logic_error for a template that does not exist, does not parse, or asks for a name that
/// `data` does not have. Nothing is escaped.
std::string render(const std::string& path, const Data& data);

/// Numbers the entries of a list and marks the last: keys `index` (from 0) and `last`.
Data listed(DataList list);

}  // namespace algest::generator
