// SPDX-License-Identifier: 0BSD
// The path of the shaft: an ellipse of 30 by 70 um, 50 times a second (Delpoux, Floquet 2015, section 4.2.3).
#pragma once
#include <cmath>

#include "magnets.hpp"

namespace magnetic_bearing {

struct Reference {
    Vector position;      ///< m
    Vector velocity;      ///< m/s
    Vector acceleration;  ///< m/s^2
};

constexpr double turn = 0.02;  ///< s

inline Reference reference(double t) {
    constexpr double y = 30e-6, z = 70e-6, w = 2.0 * 3.14159265358979323846 / turn;
    const double c = std::cos(w * t), s = std::sin(w * t);
    return {{y * c, z * s}, {-w * y * s, w * z * c}, {-w * w * y * c, -w * w * z * s}};
}

}  // namespace magnetic_bearing
