// SPDX-License-Identifier: GPL-3.0-or-later
// Units that effects put together, as people spell them.
#include "generator/tidy_unit.hpp"

#include <catch2/catch.hpp>

using algest::units::tidy;

TEST_CASE("units: products are spelled with one stroke, what cancels is left out") {
    CHECK(tidy("N.m/((rad)/s)^2") == "N.m.s^2/rad^2");
    CHECK(tidy("N.m/(rad/s)") == "N.m.s/rad");
    CHECK(tidy("V/(A)") == "V/A");
    CHECK(tidy("(m/s)/(m)") == "1/s");
    CHECK(tidy("(rad/s)/(rad/s)") == "1");
    CHECK(tidy("N/(m.s)") == "N/(m.s)");
    CHECK(tidy("N/m/s") == "N/(m.s)");
    CHECK(tidy("kg.m^2") == "kg.m^2");
    CHECK(tidy("1/(s^-1)") == "s");
}

TEST_CASE("units: what is no product of names and whole powers stays as it is") {
    for (const char* text : {"", "1e-3 ohm", "kg m^2", "m2", "m^0.5", "(m", "m)", "m^99", "degC", "nothing/known", "m//s", "m^", "{speed}"}) {
        INFO(text);
        CHECK(tidy(text) == text);
    }
    CHECK(tidy(std::string(100, '(') + "m" + std::string(100, ')')) == std::string(100, '(') + "m" + std::string(100, ')'));
}
