// SPDX-License-Identifier: GPL-3.0-or-later
// What a misspelt word was meant to be.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace algest {

/// "did you mean sampling? " where one known word is nearer than all others and near enough, else nothing: a complaint goes on
/// behind it. Capitals count as small letters. Cost: the product of the lengths, for each known word.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace algest
