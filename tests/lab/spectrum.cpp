// SPDX-License-Identifier: GPL-3.0-or-later
// Lines in a spectrum, found where they were put, and the search that places them.
#include <catch2/catch.hpp>

#include <cmath>

#include "lab/golden_section.hpp"
#include "lab/spectrum.hpp"

using namespace algest::lab;

TEST_CASE("two waves are found where they are, the stronger first") {
    const int n = 400;
    Eigen::VectorXd r(n);
    for (int k = 0; k < n; ++k) r[k] = 3 * std::sin(0.3217 * k + 0.4) + std::cos(1.1503 * k);
    const auto lines = spectral_lines(r, 2);
    REQUIRE(lines.size() == 2);
    // The other wave pulls by less than a tenth of a line's width, pi/400; lines are placed to a twentieth of one.
    CHECK(lines[0].step == Approx(0.3217).margin(0.1 * M_PI / n));
    CHECK(lines[1].step == Approx(1.1503).margin(0.1 * M_PI / n));
    CHECK(lines[0].share == Approx(0.9).margin(0.02));   // 9 : 1 in power
    CHECK(lines[1].share == Approx(0.1).margin(0.02));
}

TEST_CASE("drift is no line, and neither is nothing") {
    const int n = 200;
    Eigen::VectorXd slow(n);
    for (int k = 0; k < n; ++k) slow[k] = std::cos(M_PI * k / n);   // half a wave
    for (const SpectralLine& line : spectral_lines(slow, 3)) CHECK(line.share < 0.15);   // four half waves take 2 (8/(15 pi))^2 / 0.5 = 0.115 of it; a line is called one from 0.2 on
    CHECK(spectral_lines(Eigen::VectorXd::Zero(n), 3).empty());
}

TEST_CASE("golden section finds the valley") {
    CHECK(least_by_golden_section([](double x) { return (x - 0.7) * (x - 0.7); }, 0.0, 3.0) == Approx(0.7).margin(3.0 / 300));
}
