// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of examples/magnetic_bearing's controller: its observer's poles, its forces.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "examples/magnetic_bearing/magnets.hpp"
#include "examples/magnetic_bearing/observer.hpp"

using namespace magnetic_bearing;

TEST_CASE("bearing example: all poles of the observer's error lie where they were asked for") {
    constexpr double mass = 6.7, period = 1e-4, rate = 1900.0, force = 5.0, perturbation = -3.0;
    PerturbationObserver observer(mass, period, rate);
    std::vector<double>
        error;  // of the predicted position, under constant forces, from a shaft that is not where it is thought
    double position = 2e-5, velocity = -1e-3;
    for (int k = 0; k < 40; ++k) {
        error.push_back(position - observer.position());
        observer.correct(position);
        observer.predict(force);
        const double acceleration = (force + perturbation) / mass;
        position += period * velocity + 0.5 * period * period * acceleration;
        velocity += period * acceleration;
    }
    // (E - pole)^3 error = 0, E the shift by one sample
    const double pole = std::exp(-rate * period);
    for (std::size_t k = 0; k + 3 < error.size(); ++k) {
        const double left =
            error[k + 3] - 3.0 * pole * error[k + 2] + 3.0 * pole * pole * error[k + 1] - pole * pole * pole * error[k];
        CHECK(std::abs(left) < 1e-17);  // rounding of positions of 1e-5 m, a few of them
    }
    CHECK(std::abs(error[5]) > 1e-7);  // there is an error to speak of
}

TEST_CASE("bearing example: the magnets' forces add up to the force that is wanted, (31), and none is below the bias") {
    constexpr double bias = 20.0;
    for (const Vector& wanted :
         {Vector{0.0, 0.0}, Vector{30.0, 50.0}, Vector{-30.0, 50.0}, Vector{30.0, -50.0}, Vector{-40.0, 3.0}}) {
        const PerMagnet pull = magnet_forces(wanted, bias);
        Vector sum{0.0, 0.0};
        double least = pull[0];
        for (std::size_t k = 0; k < 3; ++k) {
            sum.y += direction[k].y * pull[k];
            sum.z += direction[k].z * pull[k];
            least = std::min(least, pull[k]);
        }
        CHECK(sum.y == Approx(wanted.y).margin(1e-12));
        CHECK(sum.z == Approx(wanted.z).margin(1e-12));
        CHECK(least == Approx(bias));  // and not more than it takes
    }
}
