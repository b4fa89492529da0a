// SPDX-License-Identifier: 0BSD
// The velocity to follow: 20 + 5 sin(2 pi 5 t) rad/s (Delpoux, Floquet 2015, section 4.1.3).
#pragma once
#include <cmath>

namespace pmsm_drive {

struct Reference {
    double omega;         ///< rad/s
    double acceleration;  ///< rad/s^2
};

constexpr double reference_period = 0.2;  ///< s

inline Reference reference(double t) {
    constexpr double rate = 2.0 * 3.14159265358979323846 / reference_period;
    return {20.0 + 5.0 * std::sin(rate * t), 5.0 * rate * std::cos(rate * t)};
}

}  // namespace pmsm_drive
