// SPDX-License-Identifier: GPL-3.0-or-later
// The radial magnetic bearing of Delpoux, Floquet (000), equations (31) to (35) with (29) and (33) as errata.md corrects
// them, in the closed loop of errata.md, "Setups behind these figures". Currents act from their sample to the next.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/plants/advance.hpp"

namespace algest::plants {

struct MagneticBearing {
    std::array<double, 3> lambda{2.53e-6, 2.04e-6, 2.42e-6};  ///< N.m^2/A^2
    double mass = 6.7;                                        ///< kg
    double gap = 5e-4;                                        ///< m
    double period = 1e-4;                                     ///< s
    double constant_force = 8.0;                              ///< N, on z
    double slow_force = 0.0;                                  ///< N, amplitude on z at 2 Hz
    double side_force = 3.0;                                  ///< N, on y

    double force_z(double t) const { return constant_force + slow_force * std::sin(2.0 * std::numbers::pi * 2.0 * t); }
};

/// Angles of the magnets: pi, -pi/3, pi/3.
inline const std::array<double, 3> magnet_sine{0.0, -std::numbers::sqrt3 / 2.0, std::numbers::sqrt3 / 2.0};
inline const std::array<double, 3> magnet_cosine{-1.0, 0.5, 0.5};

struct BearingSample {
    double Y, Z;                    ///< m, at this sample
    std::array<double, 3> current;  ///< A, from this sample to the next
};

/// What the controller believes the magnets to be.
constexpr double believed_lambda = 4e-6;

/// Flatness based tracking of the ellipse: a double pole on the force, and an integral that stands for the perturbation.
class BearingController {
public:
    explicit BearingController(const MagneticBearing& bearing) : bearing_(bearing) {}

    std::array<double, 3> currents(double t, const std::array<double, 4>& state) {
        using std::numbers::pi;
        using std::numbers::sqrt3;
        const double w = 2.0 * pi * 50.0;
        const double y = 30e-6 * std::cos(w * t), y_rate = -w * 30e-6 * std::sin(w * t);
        const double z = 70e-6 * std::sin(w * t), z_rate = w * 70e-6 * std::cos(w * t);
        const double force_y = force(-w * w * y, y_rate - state[1], y - state[0], integral_y_);
        const double force_z = force(-w * w * z, z_rate - state[3], z - state[2], integral_z_);

        constexpr double bias = 20.0;  // N
        const double side = std::abs(force_y) / sqrt3;
        std::array<double, 3> magnet{};
        magnet[0] = force_z >= side ? bias : bias + side - force_z;
        magnet[1] = magnet[0] - force_y / sqrt3 + force_z;
        magnet[2] = magnet[0] + force_y / sqrt3 + force_z;
        std::array<double, 3> out{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double air = bearing_.gap - magnet_sine[k] * state[0] - magnet_cosine[k] * state[2];
            out[k] = air * std::sqrt(magnet[k] / believed_lambda);
        }
        return out;
    }

private:
    double force(double acceleration, double rate_error, double error, double& integral) const {
        constexpr double pole = 2.0 * std::numbers::pi * 60.0;  // rad/s, twice
        integral += pole * pole * pole / 4.0 * error * bearing_.period;
        return bearing_.mass * (acceleration + 2.0 * pole * rate_error + pole * pole * error + integral);
    }

    MagneticBearing bearing_;
    double integral_y_ = 0.0;
    double integral_z_ = 0.0;
};

/// From rest in the middle.
inline std::vector<BearingSample> simulate(const MagneticBearing& bearing, int samples) {
    BearingController controller(bearing);
    std::array<double, 4> state{};  // Y, Y', Z, Z'
    std::vector<BearingSample> out;
    for (int k = 0; k < samples; ++k) {
        const double t0 = k * bearing.period;
        const std::array<double, 3> current = controller.currents(t0, state);
        out.push_back({state[0], state[2], current});
        advance(state, t0, t0 + bearing.period, [&](const auto& x, auto& dxdt, double t) {
            double force_y = bearing.side_force;
            double force_z = bearing.force_z(t);
            for (std::size_t m = 0; m < 3; ++m) {
                const double air = bearing.gap - magnet_sine[m] * x[0] - magnet_cosine[m] * x[2];
                const double force = bearing.lambda[m] * current[m] * current[m] / (air * air);
                force_y += magnet_sine[m] * force;
                force_z += magnet_cosine[m] * force;
            }
            dxdt[0] = x[1];
            dxdt[1] = force_y / bearing.mass;
            dxdt[2] = x[3];
            dxdt[3] = force_z / bearing.mass;
        });
    }
    return out;
}

}  // namespace algest::plants
