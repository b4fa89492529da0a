// SPDX-License-Identifier: 0BSD
// The three magnets of the bearing: where they pull, how far they are from the shaft, and the currents of forces. Shared by
// the simulated bearing, with the true force constants, and the controller, with those that it believes.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace magnetic_bearing {

/// Of the axes y and z, or of positions [m] and forces [N] along them.
struct Vector {
    double y, z;
};

using PerMagnet = std::array<double, 3>;

/// Sine (y) and cosine (z) of the magnets' angles pi, -pi/3, pi/3 (Delpoux, Floquet 2015, section 4.2.1).
constexpr double half_sqrt3 = 0.86602540378443864676;
constexpr std::array<Vector, 3> direction{{{0.0, -1.0}, {-half_sqrt3, 0.5}, {half_sqrt3, 0.5}}};

struct Bearing {
    PerMagnet lambda{2.53e-6, 2.04e-6, 2.42e-6};  ///< N.m^2/A^2, section 4.2.3
    double mass = 6.7;                            ///< kg
    double gap = 5e-4;                            ///< m, with the shaft in the middle
};

/// Air [m] between magnet k and the shaft, the bracket of (32).
inline double air(const Bearing& bearing, std::size_t k, const Vector& position) {
    return bearing.gap - direction[k].y * position.y - direction[k].z * position.z;
}

/// Forces of the magnets [N] that pull the shaft with `force` [N], equation (33) as its misprints are corrected: with
/// F2 - F1 = F_z - F_y/sqrt(3), F3 - F1 = F_z + F_y/sqrt(3) from (31), none pulls with less than the bias.
inline PerMagnet magnet_forces(const Vector& force, double bias = 20.0) {
    const double side = force.y / (2.0 * half_sqrt3);
    const double first = force.z >= std::abs(side) ? bias : bias + std::abs(side) - force.z;
    return {first, first - side + force.z, first + side + force.z};
}

/// The currents [A] of these forces [N], from (32).
inline PerMagnet magnet_currents(const Bearing& bearing, const PerMagnet& force, const Vector& position) {
    PerMagnet out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = air(bearing, k, position) * std::sqrt(force[k] / bearing.lambda[k]);
    return out;
}

}  // namespace magnetic_bearing
