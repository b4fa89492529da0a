// SPDX-License-Identifier: GPL-3.0-or-later
// What a misspelt word was meant to be.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace algest::model {

/// The key of `known` that is closest to a misspelt one, and all of them.
std::string suggestion(std::string_view key, const std::vector<std::string>& known);

}  // namespace algest::model
