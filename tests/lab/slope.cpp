// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes of recordings of every length, against the derivative of what was recorded.
#include "lab/slope.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using algest::lab::slopes;

namespace {

constexpr double period = 1e-3;

std::vector<double> wave(std::size_t samples, double noise) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<double> out;
    for (std::size_t k = 0; k < samples; ++k) out.push_back(std::sin(0.05 * static_cast<double>(k)) + noise * normal(random));
    return out;
}

}  // namespace

TEST_CASE("slopes: a parabola's are exact between the ends, whatever the length") {
    for (std::size_t samples = 5; samples < 40; ++samples) {
        std::vector<double> x;
        for (std::size_t k = 0; k < samples; ++k) x.push_back(3.0 * static_cast<double>(k * k));
        const auto found = slopes(x, 0.0, period);
        REQUIRE(found.size() == samples);
        for (std::size_t k = 2; k + 2 < samples; ++k) CHECK(found[k] == Approx(6.0 * static_cast<double>(k) / period));
        CHECK(found.front() == found[2]);
        CHECK(found.back() == found[samples - 3]);
    }
}

TEST_CASE("slopes: a noisy recording that is too short for the widest parabola has those of the widest that fits") {
    // Noise 0.2 beside slopes of 0.035/sample rms: 3 percent asks for 2 sum k^2 >= (0.2/(0.03*0.035))^2 = 36000, a reach of 64, 129 samples.
    // The parabola of 32 sees the wave times 3 (sin w - w cos w)/w^3 = 0.76, w = 1.6, and noise of 0.2/sqrt(22880) a sample, 1.3 a second.
    for (const std::size_t samples : {66U, 110U, 120U, 128U}) {
        INFO(samples);
        const auto found = slopes(wave(samples, 0.2), 0.2, period);
        for (std::size_t k = 32; k + 32 < samples; ++k) {
            CHECK(std::abs(found[k] - 0.76 * 50.0 * std::cos(0.05 * static_cast<double>(k))) < 4 * 1.3);
        }
    }
}

TEST_CASE("slopes: recordings without a whole parabola have none") {
    for (std::size_t samples = 0; samples < 5; ++samples) CHECK(slopes(wave(samples, 0.1), 0.1, period) == std::vector<double>(samples, 0.0));
}
