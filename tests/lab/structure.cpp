// SPDX-License-Identifier: GPL-3.0-or-later
// What has a shape and what has none, on recordings of a machine whose disturbance is known.
#include "lab/structure.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tests/lab/workplace.hpp"

using algest::lab::structured;
using algest::test::Workplace;

TEST_CASE("structure: the noise of a sensor has none") {
    const Workplace w([](std::size_t, double) { return 0.0; });
    CHECK_FALSE(structured(*w.bench, *w.nominal));
}

TEST_CASE("structure: the noise of the machine itself has none, however large") {
    std::mt19937 random(5);
    std::normal_distribution<double> noise;
    const Workplace w([&](std::size_t, double) { return 0.5 * noise(random); });
    CHECK_FALSE(structured(*w.bench, *w.nominal));
}

TEST_CASE("structure: nor has a sensor that is noisier than it says") {
    const Workplace w([](std::size_t, double) { return 0.0; }, 0.01);
    CHECK_FALSE(structured(*w.bench, *w.nominal));
}

TEST_CASE("structure: what hangs on a signal has one") {
    const Workplace dry([](std::size_t, double x) { return x > 0 ? -0.3 : 0.3; });
    CHECK(structured(*dry.bench, *dry.nominal));
    const Workplace cubic([](std::size_t, double x) { return -0.5 * x * x * x; });
    CHECK(structured(*cubic.bench, *cubic.nominal));
}

TEST_CASE("structure: what hangs on the past of a signal has one") {
    std::vector<double> past;
    const Workplace w([&](std::size_t row, double x) {
        past.push_back(x);
        return row < 100 ? 0.0 : 0.3 * (past[row - 100] > 0 ? 1 : -1);
    });
    CHECK(structured(*w.bench, *w.nominal));
}

TEST_CASE("structure: a wave that no signal foretells stands in one line, the same power in many lines is noise") {
    const Workplace wave([](std::size_t row, double) { return 0.05 * std::sin(7.3 * 0.01 * static_cast<double>(row)); });
    CHECK(structured(*wave.bench, *wave.nominal));
    std::mt19937 random(7);
    std::normal_distribution<double> noise;
    const Workplace many([&](std::size_t, double) { return 0.05 / std::sqrt(2.0) * noise(random); });
    CHECK_FALSE(structured(*many.bench, *many.nominal));
}
