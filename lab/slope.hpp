// SPDX-License-Identifier: GPL-3.0-or-later
// The derivative of a recorded signal, off line: with samples from both sides.
#pragma once
#include <vector>

namespace algest::lab {

/// Slope by sample, per second, of a parabola through the samples around it, as wide as the noise (standard deviation) needs to be 3
/// percent of the slope's rms, at most 64 samples on each side, and no more than the recording has. Near the ends, the slope of the nearest
/// whole parabola. Fewer than 5 samples have none: zeros.
/// Cost: samples times the width.
std::vector<double> slopes(const std::vector<double>& x, double noise, double period);

}  // namespace algest::lab
