// SPDX-License-Identifier: 0BSD
// The closed loop at 10 kHz: noisy positions, controller and estimator, which retunes the controller.
#pragma once
#include <random>
#include <vector>

#include "controller.hpp"
#include "estimator_input.hpp"
#include "plant.hpp"

namespace magnetic_bearing {

constexpr double period = 1e-4;          ///< s
constexpr double fed_from = 0.36;        ///< s: the estimator gets its first sample
constexpr double duration = 0.7;         ///< s
constexpr double position_noise = 5e-8;  ///< m, uniform, of both positions: that of a good eddy-current sensor

struct Instant {
    double t;  ///< s
    Reference wanted;
    State shaft;
    Vector perturbation;  ///< N, as the controller's observer sees it
    PerMagnet current;    ///< A, held from here on
    Estimator::Estimate estimate;
    bool fed;      ///< the estimator gets samples
    bool retuned;  ///< the controller has had an estimate
};

inline PerMagnet lambda(const Estimator::Estimate& e) { return {e.lambda1, e.lambda2, e.lambda3}; }

/// One run, an instant every period. The shaft starts at rest in the middle.
inline std::vector<Instant> run() {
    Estimator estimator;
    auto estimate = estimator.estimate();  // nothing pushed yet: the initial values of the model file, wrong on purpose
    bool retuned = false;
    Bearing believed;
    believed.lambda = lambda(estimate);
    Controller controller(believed, period);

    const Bearing bearing;
    const auto unknown_force = [](double) { return Vector{3.0, 8.0}; };  // N
    std::mt19937 random(1);
    const auto noise = [&] { return position_noise * (static_cast<double>(random()) / 2147483648.0 - 1.0); };
    State shaft;
    PerMagnet before{};
    std::vector<Instant> out;
    for (int k = 0; k < static_cast<int>(duration / period + 0.5); ++k) {
        const double t = k * period;
        const bool fed = t > fed_from - 0.5 * period;
        const Reference wanted = reference(t);
        const double noise_y = noise(), noise_z = noise();
        const Vector position{shaft.position.y + noise_y, shaft.position.z + noise_z};
        const PerMagnet current = controller.currents(wanted, position);
        out.push_back({t, wanted, shaft, controller.perturbation(), current, estimate, fed, retuned});

        if (fed) {
            estimate = estimator.step(estimator_input(position, before, current));
            if (estimate.status == algest::Status::ok) {
                controller.retune(lambda(estimate));
                retuned = true;
            }
        }
        shaft = advance(bearing, shaft, t, t + period, current, unknown_force);
        before = current;
    }
    return out;
}

}  // namespace magnetic_bearing
