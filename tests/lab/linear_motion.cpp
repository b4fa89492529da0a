// SPDX-License-Identifier: GPL-3.0-or-later
// Exact steps of linear systems.
#include "lab/linear_motion.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

TEST_CASE("linear motion: the step's matrices are those of an oscillator, slow and fast beside the period") {
    // A = w [0 1; -1 0]: phi1 and h phi2 are the integral of its rotation over h, and the integral of that.
    const double h = 0.01;
    for (const double w : {1.0, 30.0, 4000.0}) {
        Eigen::MatrixXd a(2, 2);
        a << 0, w, -w, 0;
        const auto step = algest::lab::linear_step(a, h);
        const double s = std::sin(w * h);
        const double c = std::cos(w * h);
        const double digits = 1e-14 * (1 + w * h);   // what squaring loses: the turns of the angle
        CHECK(step.phi1(0, 0) * w == Approx(s).epsilon(0).margin(digits));
        CHECK(step.phi1(0, 1) * w == Approx(1 - c).epsilon(0).margin(digits));
        CHECK(step.phi1(1, 0) * w == Approx(-(1 - c)).epsilon(0).margin(digits));
        CHECK(h * step.phi2(0, 0) * w * w == Approx(1 - c).epsilon(0).margin(digits));
        CHECK(h * step.phi2(1, 0) * w * w == Approx(-(w * h - s)).epsilon(0).margin(digits));
    }
}

TEST_CASE("linear motion: rates that are no numbers give a step that is none") {
    const auto step = algest::lab::linear_step(Eigen::MatrixXd::Constant(1, 1, std::numeric_limits<double>::infinity()), 0.01);
    CHECK(std::isnan(step.phi1(0, 0)));
}
