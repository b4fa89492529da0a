// SPDX-License-Identifier: GPL-3.0-or-later
// Experiment signals as an engineer would choose them: sums of sines, steps, or both.
#pragma once
#include <cstddef>
#include <vector>

#include "random.hpp"

namespace algest::gap {

/// `count` sines with frequencies spread over [lowest, highest] Hz, root mean square 1.
std::vector<double> sines(Random& random, std::size_t samples, double period, int count, double lowest, double highest);

/// Random levels in [-1, 1], each held for 0.5 to 1.5 times `hold` seconds.
std::vector<double> steps(Random& random, std::size_t samples, double period, double hold);

/// One of: many sines and steps, a few sines, steps alone; between about -1 and 1.
std::vector<double> excitation(Random& random, std::size_t samples, double period, double lowest, double highest);

/// offset + factor times each value.
std::vector<double> scaled(std::vector<double> values, double factor, double offset = 0);

}  // namespace algest::gap
