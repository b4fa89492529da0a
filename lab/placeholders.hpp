// SPDX-License-Identifier: GPL-3.0-or-later
// {name} in the texts of an effect: what is known only once it is bound to an equation.
#pragma once
#include <map>
#include <string>

namespace algest::lab {

/// The text with every {name} replaced by what stands beside the name; others stay.
std::string filled(std::string text, const std::map<std::string, std::string>& with);
/// The same of a unit: empty, which is unknown, where one that stands in it is.
std::string filled_unit(const std::string& text, const std::map<std::string, std::string>& with);

}  // namespace algest::lab
