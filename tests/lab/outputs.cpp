// SPDX-License-Identifier: GPL-3.0-or-later
// Output equations y = formula, hidden states, and parameters that enter nonlinearly: free runs, fits and refusals.
#include <catch2/catch.hpp>

#include <cmath>

#include "lab/fit.hpp"
#include "lab/outputs.hpp"
#include "lab/weak_form.hpp"
#include "tests/lab/scene.hpp"

namespace {

using algest::lab::FreeRun;
using algest::test::Scene;

constexpr double period = 0.01;

/// x' = u - 2 x from x(0) = 0.5, seen by a sensor that says `sensor`; u = -3 from the start: x = -1.5 + 2 exp(-2 t) passes zero at 0.144 s.
std::string seen(const std::string& sensor, const std::string& more = "") {
    return "name = \"m\"\n[sampling]\nperiod = 0.01\n[signals]\nu = { unit = \"m/s\", hold = \"zoh\" }\nx = { unit = \"m\", initial = 0.5 }\ny = { unit = \"m\" }\nz = { unit = \"m\" }\n"
           "[parameters]\na = { unit = \"1/s\", initial = 2, min = 0 }\ng = { unit = \"1\", initial = 1.25 }\ntau = { unit = \"s\", initial = 0.025, min = 0 }\n"
           "[[equation]]\nname = \"motion\"\node = \"der(x) = u - a*x\"\n[[equation]]\nname = \"sensor\"\node = \"" + sensor + "\"\n" + more;
}

double x(double t) { return -1.5 + 2 * std::exp(-2 * t); }
double minus_three(double) { return -3; }

const std::string second = "[[equation]]\nname = \"second\"\node = ";

}  // namespace

TEST_CASE("output: a sensor that loses the sign, one with a gain, one after the other") {
    Scene scene(seen("y = abs(z)", second + "\"z = g*x - 0.125*u/a\"\n"));
    const FreeRun run = scene.run(100, {{"u", minus_three}});
    REQUIRE(run.samples == 100);
    for (std::size_t k = 0; k < 100; ++k) {
        const double z = 1.25 * x(period * static_cast<double>(k)) + 0.1875;
        REQUIRE(scene.of(run, "z")[k] == Approx(z).margin(1e-7));   // 100 steps of local error 1e-8, fading
        REQUIRE(scene.of(run, "y")[k] == Approx(std::abs(z)).margin(1e-7));
    }
}

TEST_CASE("output: a late sensor, by any part of a sample; the first value before the first sample") {
    for (const char* tau : {"0.025", "0.03", "0.0007", "tau"}) {
        Scene scene(seen(std::string("y = delay(x, ") + tau + ")"));
        const double late = tau[0] == 't' ? 0.025 : std::atof(tau);
        const FreeRun run = scene.run(100, {{"u", minus_three}});
        for (std::size_t k = 0; k < 100; ++k) {
            // The cubic between samples misses by (2 * 0.01)^4/384 of what moves: 1e-9.
            REQUIRE(scene.of(run, "y")[k] == Approx(x(std::max(period * static_cast<double>(k) - late, 0.0))).margin(1e-7));
        }
    }
}

TEST_CASE("output: a law sees what the sensor says, not what it measures") {
    // x' = u, u = -5 y, y = 2 x: at every sample x falls by the factor 1 - 10 * 0.01.
    Scene scene(R"toml(name = "m"
[sampling]
period = 0.01
[signals]
u = { unit = "m/s", hold = "zoh" }
x = { unit = "m", initial = 1 }
y = { unit = "m" }
w = { unit = "m/s" }
[parameters]
g = { unit = "1", initial = 2 }
[constants]
K = { unit = "1/s", value = 5 }
[[equation]]
ode = "der(x) = u"
[[equation]]
ode = "y = g*x"
[[equation]]
ode = "w = u"
[[feedback]]
signal = "u"
law = "-K*y"
)toml");
    const FreeRun run = scene.run(50, {{"u", minus_three}});
    for (std::size_t k = 0; k < 50; ++k) {
        const double now = std::pow(0.9, static_cast<double>(k));
        REQUIRE(scene.of(run, "x")[k] == Approx(now).margin(1e-9));
        REQUIRE(scene.of(run, "w")[k] == Approx(-10 * now).margin(1e-8));   // of this sample, not of the last
    }
}

TEST_CASE("output: a model in which nothing moves shows what its formulas make of the recording") {
    Scene scene("name = \"m\"\n[sampling]\nperiod = 0.01\n[signals]\nu = { unit = \"m\" }\ny = { unit = \"m\" }\n[parameters]\ng = { unit = \"1/m\", initial = 2 }\n"
                "[[equation]]\node = \"y = g*u*abs(u)\"\n");
    const FreeRun run = scene.run(30, {{"u", minus_three}});
    REQUIRE(run.samples == 30);
    for (const double y : scene.of(run, "y")) CHECK(y == Approx(-18.0));
}

TEST_CASE("output: where a sensor shows no number the run ends") {
    Scene scene(seen("y = sqrt(x)*g"));
    const FreeRun run = scene.run(100, {{"u", minus_three}});
    CHECK(run.samples == 15);   // x passes zero at log(2/1.5)/2 = 0.144 s
    Scene never(seen("y = g*sqrt(x*(x - 2*x))"));
    const FreeRun none = never.run(100, {{"u", minus_three}});
    CHECK(none.samples == 1);
    CHECK(none.signals[2] == std::vector<double>{0.0});
}

TEST_CASE("output: it is scored, and a fit finds hidden initial value, gain and delay by it") {
    Scene scene(seen("y = g*delay(x, tau)"));
    const auto u = [](double t) { return std::sin(40 * std::floor(t / 0.07 + 1e-9)); };
    const FreeRun truth = scene.run(600, {{"u", u}});
    const std::vector<double> shown = scene.of(truth, "y");
    auto recording = scene.recorded(600, {{"u", u}, {"y", [&](double t) { return shown[static_cast<std::size_t>(std::lround(t / period))]; }}});
    const auto bench = algest::lab::bench(scene.model, recording, scene.diagnostics);
    REQUIRE(bench);
    CHECK(algest::lab::scored_outputs(scene.model, *bench) == std::vector<int>{2});
    CHECK_FALSE(algest::lab::has_weak_form(scene.model, *bench, 0));   // x is hidden
    CHECK_FALSE(algest::lab::has_weak_form(scene.model, *bench, 1));   // an output has no rows
    const auto found = algest::lab::fit(scene.model, *bench, {{1.5, 1.0, 0.01}, {}, {0.1}, {0, 600}});
    CHECK(found.parameters[0] == Approx(2.0).epsilon(1e-4));   // the fit stops at a relative change of 1e-7 of the cost
    CHECK(found.parameters[1] == Approx(1.25).epsilon(1e-4));
    CHECK(found.parameters[2] == Approx(0.025).epsilon(1e-3));
    CHECK(found.initial[0] == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("output: what contradicts is refused where it stands") {
    const auto says = [](const std::string& model, int line, int column, const std::string& words) {
        INFO(model);
        Scene scene(model);
        const auto said = scene.refusal();
        INFO(said.text());
        CHECK((said.at.line == line && said.at.column == column));
        CHECK(said.what.find(words) != std::string::npos);
    };
    says(seen("y = g*y"), 18, 14, "'y' is given by itself");
    says(seen("y = g*z", second + "\"z = y - x\"\n"), 21, 12, "'y' is given by itself");
    says(seen("x = g*z"), 18, 8, "'x' is given here, and another equation moves it");
    says(seen("y = x", second + "\"y = g*x\"\n"), 21, 8, "a second equation gives 'y'");
    says(seen("y = x", "[[feedback]]\nsignal = \"y\"\nlaw = \"2*x\"\n"), 18, 8, "a law sets it");
    says(seen("y = x", second + "\"der(z) = a*y\"\n"), 21, 19, "'y' is what a sensor shows (equation 'sensor')");
    says(seen("y = x", second + "\"z = delay(y, 0.1)\"\n"), 21, 12, "'y' is an output, and its past is not kept");
    says(seen("g*y = x"), 18, 7, "has no derivative left to give");
}

TEST_CASE("nonlinear: a parameter inside a function and in an exponent is fitted in free run") {
    const std::string text = R"toml(name = "m"
[sampling]
period = 0.01
[signals]
u = { unit = "1/s", hold = "zoh" }
x = { unit = "1", initial = 0.5 }
[constants]
rate = { unit = "1/s", value = 1 }
[parameters]
s = { unit = "1", initial = 0.7, min = 0.1 }
p = { unit = "1", initial = 1.5, min = 1 }
[[equation]]
ode = "der(x) = u - rate*x*exp(-abs(x)/s) - rate*sgn(x)*abs(x)^p"
)toml";
    Scene scene(text);
    const auto u = [](double t) { return 2 * std::sin(40 * std::floor(t / 0.3 + 1e-9)); };
    const FreeRun truth = scene.run(1000, {{"u", u}});
    const std::vector<double> seen_x = scene.of(truth, "x");
    const auto recording = scene.recorded(1000, {{"u", u}, {"x", [&](double t) { return seen_x[static_cast<std::size_t>(std::lround(t / period))]; }}});
    const auto bench = algest::lab::bench(scene.model, recording, scene.diagnostics);
    REQUIRE(bench);
    const auto found = algest::lab::fit(scene.model, *bench, {{1.0, 1.2}, {}, bench->initial, {0, 1000}});
    CHECK(found.parameters[0] == Approx(0.7).epsilon(1e-3));   // the fit stops at a relative change of 1e-7 of the cost
    CHECK(found.parameters[1] == Approx(1.5).epsilon(1e-3));
}
