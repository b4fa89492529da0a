// SPDX-License-Identifier: GPL-3.0-or-later
// The opposite of a sum.
#pragma once
#include <string>

namespace algest::lab {

/// A sum with the sign of each of its terms turned, its layout kept: "-a*(b - c) + d" becomes "+a*(b - c) - d", "a - b" becomes "-a + b".
/// It may hold {placeholders}.
std::string turned(const std::string& sum);

}  // namespace algest::lab
