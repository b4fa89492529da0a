// SPDX-License-Identifier: 0BSD
// What the estimator of the bearing gets: positions, and for each magnet the mean square of its current.
#pragma once
#include <magnetic_bearing/magnetic_bearing.hpp>

#include "magnets.hpp"

namespace magnetic_bearing {

using Estimator = algest::generated::MagneticBearing;

/// Half a period of timing is several percent of lambda: the square is averaged over the period around the sample, half of which
/// is under the current before and half under the current after.
inline Estimator::Sample estimator_input(const Vector& position, const PerMagnet& before, const PerMagnet& after) {
    const auto mean_square = [&](std::size_t k) { return 0.5 * (before[k] * before[k] + after[k] * after[k]); };
    return {position.z, position.y, mean_square(0), mean_square(1), mean_square(2)};
}

}  // namespace magnetic_bearing
