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

TEST_CASE("remainder: one law takes the place of several effects that imitate it, and of no others") {
    const auto one_for = [](const std::function<double(std::size_t, double)>& hidden, const std::string& terms) {
        Workplace w(hidden);
        std::string text = w.nominal->text;
        text.replace(text.find("- a*x"), 5, "- a*x - " + terms);
        text.replace(text.find("[[equation]]"), 0, "c = { initial = 0 }\nd = { initial = 0 }\n");
        w.bench->begin_search();
        w.bench->fit_and_score(*w.nominal, w.nominal->fit.parameters, w.nominal->fit.initial);
        auto named = w.bench->prepare(text, {{}, {}}, w.said);
        REQUIRE(named);
        std::vector<double> start = w.nominal->fit.parameters;
        start.insert(start.end(), {0.0, 0.0});
        w.bench->fit_and_score(*named, start, w.nominal->fit.initial);
        return algest::lab::plainer_law(*w.bench, *w.nominal, *named);
    };
    const auto square = one_for([](std::size_t, double x) { return -0.4 * x * x; }, "c*x^2 - d*x^3");
    REQUIRE(square);
    CHECK(square->term.find("x^2") != std::string::npos);
    CHECK_FALSE(one_for([](std::size_t, double x) { return -0.4 * x * x - 0.3; }, "c*x^2 - d"));
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
