// SPDX-License-Identifier: GPL-3.0-or-later
// What a fitted model leaves: a law, or noise of the sensor or of the machine itself.
#include "lab/remainder.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tests/lab/workplace.hpp"

namespace {

using algest::lab::Remainder;
using algest::test::Workplace;

std::optional<Remainder> left(const Workplace& w) {
    w.bench->begin_search();
    w.bench->fit_and_score(*w.nominal, w.nominal->fit.parameters, w.nominal->fit.initial);
    return algest::lab::remainder(*w.bench, *w.nominal);
}

}  // namespace

TEST_CASE("remainder: a law that the fit bends into its own shape still shows, and is told") {
    const auto cubic = left(Workplace([](std::size_t, double x) { return -0.05 * x * x * x; }));
    REQUIRE(cubic);
    CHECK(cubic->term.find("x^3") != std::string::npos);
    CHECK(left(Workplace([](std::size_t, double x) { return -0.05 * x * x; })));
}

TEST_CASE("remainder: a fit that is right leaves none, with noise of the sensor or of the machine itself") {
    CHECK_FALSE(left(Workplace([](std::size_t, double) { return 0.0; })));
    for (const unsigned seed : {5U, 6U, 7U}) {   // white over 10 ms; and what lasts for 2 s, a quarter of the slowest stretch of the excitation
        std::mt19937 random(seed);
        std::normal_distribution<double> noise;
        CHECK_FALSE(left(Workplace([&](std::size_t, double) { return 0.5 * noise(random); })));
        double lasting = 0;
        CHECK_FALSE(left(Workplace([&](std::size_t, double) { return lasting += -0.005 * lasting + 0.01 * noise(random); })));
    }
}
