// SPDX-License-Identifier: GPL-3.0-or-later
// What `check --identifiability` says of a model.
#pragma once
#include <nlohmann/json.hpp>

#include <string>

#include "generator/structural_identifiability.hpp"

namespace algest::cli {

/// A table of parameters, for people.
std::string text(const structure::Structure& structure);
/// {"measured", "inputs", "hidden", "parameters": [{"name", "verdict", "values", "seen_in"}], "combinations": [{"name", "verdict", "values"}]}.
nlohmann::ordered_json json(const structure::Structure& structure);

}  // namespace algest::cli
