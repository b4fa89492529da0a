// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/doubt.hpp"

#include <catch2/catch.hpp>

using namespace algest;

TEST_CASE("doubt: what speaks against a number") {
    model::Parameter kt{"kt", {}, "V.s/rad", exact::Rational(2) / 5, exact::Rational(0), exact::Rational(1)};
    CHECK_FALSE(lab::doubt(kt, 0.39, 0.01));
    CHECK_FALSE(lab::doubt(kt, 0.39, std::nullopt));
    CHECK_FALSE(lab::doubt(kt, 0.75, 0.25));   // three deviations
    CHECK(lab::doubt(kt, 0.29, 0.1) == "kt = 0.29 is 2.9 of its standard deviations and hardly told from zero");
    CHECK(lab::doubt(kt, -0.147, 0.079) == "kt = -0.147 is 1.9 of its standard deviations and hardly told from zero, and contradicts min = 0");
    CHECK(lab::doubt(kt, -0.5, 0.01) == "kt = -0.5 contradicts min = 0");
    CHECK(lab::doubt(kt, 1.5, std::nullopt) == "kt = 1.5 contradicts max = 1");
    kt.min.reset();
    CHECK(lab::doubt(kt, -0.5, 0.01) == "kt = -0.5 contradicts the sign of initial = 0.4");
    kt.initial = 0;
    CHECK_FALSE(lab::doubt(kt, -0.5, 0.01));
}
