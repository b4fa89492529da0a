// SPDX-License-Identifier: GPL-3.0-or-later
// The bearing of examples/magnetic_bearing in the closed loop of errata.md, "Setups behind these figures": state feedback and an
// integral, where the example has an observer. Currents act from their sample to the next.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "examples/magnetic_bearing/plant.hpp"
#include "examples/magnetic_bearing/reference.hpp"

namespace algest::plants {

struct MagneticBearing : magnetic_bearing::Bearing {
    double period = 1e-4;         ///< s
    double constant_force = 8.0;  ///< N, on z
    double slow_force = 0.0;      ///< N, amplitude on z at 2 Hz
    double side_force = 3.0;      ///< N, on y

    double force_z(double t) const { return constant_force + slow_force * std::sin(2.0 * std::numbers::pi * 2.0 * t); }
};

struct BearingSample {
    double Y, Z;                    ///< m, at this sample
    std::array<double, 3> current;  ///< A, from this sample to the next
};

/// Flatness based tracking of the ellipse: a double pole on the force, and an integral that stands for the perturbation.
class BearingController {
public:
    BearingController(const magnetic_bearing::Bearing& believed, double period) : believed_(believed), period_(period) {}

    std::array<double, 3> currents(double t, const magnetic_bearing::State& state) {
        const magnetic_bearing::Reference wanted = magnetic_bearing::reference(t);
        const magnetic_bearing::Vector force{needed(wanted.acceleration.y, wanted.velocity.y - state.velocity.y,
                                                    wanted.position.y - state.position.y, integral_y_),
                                             needed(wanted.acceleration.z, wanted.velocity.z - state.velocity.z,
                                                    wanted.position.z - state.position.z, integral_z_)};
        return magnet_currents(believed_, magnet_forces(force), state.position);
    }

private:
    double needed(double acceleration, double rate_error, double error, double& integral) const {
        constexpr double pole = 2.0 * std::numbers::pi * 60.0;  // rad/s, twice
        integral += pole * pole * pole / 4.0 * error * period_;
        return believed_.mass * (acceleration + 2.0 * pole * rate_error + pole * pole * error + integral);
    }

    magnetic_bearing::Bearing believed_;
    double period_;
    double integral_y_ = 0.0;
    double integral_z_ = 0.0;
};

/// From rest in the middle; the controller believes all magnets to be 4e-6 N.m^2/A^2 throughout.
inline std::vector<BearingSample> simulate(const MagneticBearing& bearing, int samples) {
    magnetic_bearing::Bearing believed = bearing;
    believed.lambda = {4e-6, 4e-6, 4e-6};
    BearingController controller(believed, bearing.period);
    magnetic_bearing::State state;
    std::vector<BearingSample> out;
    for (int k = 0; k < samples; ++k) {
        const double t = k * bearing.period;
        const std::array<double, 3> current = controller.currents(t, state);
        out.push_back({state.position.y, state.position.z, current});
        state = advance(bearing, state, t, t + bearing.period, current, [&](double at) {
            return magnetic_bearing::Vector{bearing.side_force, bearing.force_z(at)};
        });
    }
    return out;
}

}  // namespace algest::plants
