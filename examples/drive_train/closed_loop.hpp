// SPDX-License-Identifier: 0BSD
// The closed loop from rest, a step of the wanted speed; and what is said of it.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "identification.hpp"
#include "loop_shaping.hpp"

namespace drive_train {

constexpr double wanted_speed = 20.0;   ///< rad/s
constexpr double step_at = 0.5;         ///< s
constexpr double duration = 10.5;       ///< s

struct Instant {
    double t;        ///< s
    double wanted;   ///< rad/s
    double omega;    ///< rad/s
    double u;        ///< V, held from here on
};

/// An instant every period.
inline std::vector<Instant> run(const Design& design, bool with_notches) {
    Plant plant(period);
    Sensor sensor;
    Controller controller(design, with_notches, period);
    std::vector<Instant> out;
    for (int k = 0; k < static_cast<int>(duration / period + 0.5); ++k) {
        const double t = k * period;
        const double wanted = t > step_at - 0.5 * period ? wanted_speed : 0.0;
        const double u = controller.command(wanted, sensor.measured(plant.omega()));
        out.push_back({t, wanted, plant.omega(), u});
        plant.advance(u);
    }
    return out;
}

/// Share of the step by which the speed passes it at most.
inline double overshoot(const std::vector<Instant>& of) {
    double most = 0.0;
    for (const Instant& i : of) most = std::max(most, i.omega);
    return most / wanted_speed - 1.0;
}

/// Mean over the last two seconds, relative to the step.
inline double steady_state(const std::vector<Instant>& of) {
    const int count = static_cast<int>(2.0 / period);
    double sum = 0.0;
    for (auto i = of.end() - count; i != of.end(); ++i) sum += i->omega;
    return sum / count / wanted_speed - 1.0;
}

/// Of the speed behind a band-pass, a tenth of its middle frequency [rad/s] wide, since a wider one would measure the rise of the step itself:
/// integral of the square, rad^2/s.
inline double energy_around(double frequency, const std::vector<Instant>& of) {
    constexpr double half_width = 0.05;
    const double w = frequency;
    Filter band({{0.0, 2.0 * half_width / w, 0.0}, {1.0, 2.0 * half_width / w, 1.0 / (w * w)}, 0}, period);
    double sum = 0.0;
    for (const Instant& i : of) {
        const double y = band.step(i.omega);
        sum += y * y * period;
    }
    return sum;
}

}  // namespace drive_train
