// SPDX-License-Identifier: GPL-3.0-or-later
// The term of an effect, checked before there is an equation for it to enter.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "generator/toml_access.hpp"
#include "lab/effect.hpp"

namespace algest::lab {

/// A placeholder {name} of a term, and the units that what it stands for may have; empty: any.
using Placeholders = std::map<std::string, std::vector<std::string>>;

/// What stands for the roles of an effect.
Placeholders placeholders_of(const Effect& effect);
/// What stands for the axes of a rotating frame in the terms d and q.
Placeholders axes_of_a_frame();

/// Complains where the text at `node` is no sum of products of one parameter each with functions of placeholders and scanned
/// numbers, or where its unit is not that of an equation that the effect may enter, whatever stands for its placeholders.
/// The names and placeholders that stand in it are added to `used`.
void check_term(const Effect& effect, const std::string& text, const Placeholders& placeholders, const toml::node& node,
                model::TomlAccess& file, std::set<std::string>& used);

}  // namespace algest::lab
