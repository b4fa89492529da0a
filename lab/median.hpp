// SPDX-License-Identifier: GPL-3.0-or-later
// The middle of some numbers.
#pragma once
#include <optional>
#include <vector>

namespace algest::lab {

/// Of an even count the mean of the two in the middle; empty: of nothing. Cost: linear.
std::optional<double> median(std::vector<double> values);

}  // namespace algest::lab
