// SPDX-License-Identifier: GPL-3.0-or-later
// Units of equations, spelled as the model spells what stands in them.
#include "generator/equation_unit.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/lab/scene.hpp"

namespace {

std::string unit_of(const std::string& ode) {
    algest::test::Scene scene(fmt::format(R"toml(name = "cylinder"
[sampling]
period = 1e-3
[signals]
q = {{ unit = "cm^3/s" }}
v = {{ unit = "cm/s" }}
p = {{ unit = "MPa" }}
[constants]
A = {{ value = 5, unit = "cm^2" }}
[parameters]
m = {{ unit = "MPa.cm.s^2", initial = 1 }}
k = {{ unit = "cm^3/MPa", initial = 1 }}
[[equation]]
ode = "{}"
)toml", ode));
    return algest::model::equation_unit(scene.model, scene.model.equations[0]);
}

}  // namespace

TEST_CASE("unit of an equation: the shortest that a term spells") {
    CHECK(unit_of("k*der(p) = q - A*v") == "cm^3/s");
    CHECK(unit_of("k*der(p) + A*v = 0") == "cm^3/s");
    CHECK(unit_of("m*der(v) = A*p") == "MPa.cm^2");   // of two that are as short, the first
    CHECK(unit_of("-(m*der(v) - 2*p*A) = A*p/1") == "MPa.cm^2");
}

TEST_CASE("unit of an equation: where no term is a product, as UDUNITS prints it") {
    CHECK(unit_of("abs(q) = abs(A*v)") == "1e-06 m3.s-1");
}
