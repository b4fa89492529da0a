// SPDX-License-Identifier: GPL-3.0-or-later
// The values that a scan goes through.
#pragma once
#include <vector>

#include "lab/effect.hpp"

namespace algest::lab {

/// From the first to the last, by steps or by a factor. unit: what the range is counted in.
std::vector<double> scan_values(const EffectScan& scan, double unit);

}  // namespace algest::lab
