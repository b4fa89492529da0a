// SPDX-License-Identifier: GPL-3.0-or-later
// delay(x, tau): free runs, rows and fits against solutions written down here.
#include <catch2/catch.hpp>

#include <cmath>

#include "lab/fit.hpp"
#include "lab/past.hpp"
#include "lab/weak_form.hpp"
#include "tests/lab/scene.hpp"

namespace {

using algest::lab::FreeRun;
using algest::test::Scene;

constexpr double period = 0.01;

/// x' = 3 input - 2 x, u in the given hold.
std::string lag(const std::string& hold, const std::string& input) {
    return "name = \"lag\"\n[sampling]\nperiod = 0.01\n[signals]\nu = { unit = \"V\", hold = \"" + hold +
           "\" }\nx = { unit = \"m\", initial = 0 }\n[constants]\nT0 = { unit = \"s\", value = 0.0137 }\n[parameters]\na = { unit = \"1/s\", initial = 2 }\n"
           "b = { unit = \"m/(V.s)\", initial = 3 }\ntau = { unit = \"s\", initial = 0.0137, min = 0 }\n[[equation]]\node = \"der(x) = b*" + input + " - a*x\"\n";
}

/// Some value that changes every 70 ms.
double step(double t) { return std::sin(40 * std::floor(t / 0.07 + 1e-9)); }

/// x' = 3 u(t - 0.0137) - 2 x over held samples: within a period u is first that of two samples ago, from 3.7 ms on that of the last one.
std::vector<double> lagging_answer(std::size_t samples) {
    std::vector<double> out = {0.0};
    const auto u = [](std::size_t row, std::size_t back) { return step(period * static_cast<double>(row > back ? row - back : 0)); };
    for (std::size_t row = 0; row + 1 < samples; ++row) {
        double x = out.back();
        for (const auto& [value, time] : {std::pair(u(row, 2), 0.0037), std::pair(u(row, 1), 0.0063)}) x = std::exp(-2 * time) * x + (1 - std::exp(-2 * time)) / 2 * 3 * value;
        out.push_back(x);
    }
    return out;
}

}  // namespace

TEST_CASE("delay: of a held input by a part of a sample, known or a parameter") {
    const std::vector<double> answer = lagging_answer(400);
    for (const char* input : {"delay(u, 0.0137)", "delay(u, T0)", "delay(u, T0/2 + T0/2)", "delay(u, tau)"}) {
        Scene scene(lag("zoh", input));
        const FreeRun run = scene.run(400, {{"u", step}});
        REQUIRE(run.samples == 400);
        for (std::size_t k = 0; k < 400; ++k) REQUIRE(scene.of(run, "x")[k] == Approx(answer[k]).margin(1e-7));   // 800 steps of local error 1e-8, most of them far less
    }
}

TEST_CASE("delay: of a ramp between samples; the first value before the first sample") {
    Scene scene(lag("linear", "delay(u, 0.0137)"));
    const FreeRun run = scene.run(200, {{"u", [](double t) { return 1 + t; }}});
    for (std::size_t k = 0; k < 200; ++k) {
        // u is 1 up to 13.7 ms, then 1 + t - 0.0137.
        const double t = period * static_cast<double>(k);
        const double since = std::max(t - 0.0137, 0.0);
        const double x = 1.5 * (1 - std::exp(-2 * t)) + 1.5 * (since - (1 - std::exp(-2 * since)) / 2);
        REQUIRE(scene.of(run, "x")[k] == Approx(x).margin(1e-7));
    }
}

TEST_CASE("delay: a machine that is at rest at the first sample was not driven before it, one that moves was") {
    for (const auto& [first, second] : {std::pair(0.0, 0.0), std::pair(0.4, 0.4), std::pair(0.0, 0.4)}) {   // the last passes through zero
        Scene scene(lag("zoh", "delay(u, 0.0137)"));
        const FreeRun run = scene.run(200, {{"u", [](double) { return 1.0; }}, {"x", [first = first, second = second](double t) { return t > 1.5 * period ? 0.5 : t > 0.5 * period ? second : first; }}});
        const double late = second > 0 ? 0.0 : 0.0137;
        for (std::size_t k = 0; k < 200; ++k) {
            const double since = std::max(period * static_cast<double>(k) - late, 0.0);
            REQUIRE(scene.of(run, "x")[k] == Approx(1.5 * (1 - std::exp(-2 * since))).margin(1e-7));   // the model's own initial value is 0
        }
    }
}

TEST_CASE("delay: by nothing, and by more than the recording is long") {
    Scene now(lag("zoh", "delay(u, 0)"));
    Scene plain(lag("zoh", "u"));
    const FreeRun a = now.run(100, {{"u", step}});
    const FreeRun b = plain.run(100, {{"u", step}});
    CHECK(now.of(a, "x") == plain.of(b, "x"));
    Scene never(lag("zoh", "delay(u, 1e6)"));
    const FreeRun run = never.run(100, {{"u", [](double t) { return 1 + t; }}});
    CHECK(never.of(run, "x")[99] == Approx(1.5 * (1 - std::exp(-2 * 0.99))).margin(1e-7));
}

TEST_CASE("delay: a relay under a delayed force sticks and slips in time") {
    // 2 v' = F(t - 0.0137) - 3 sgn(v): at rest under 2 N, away under 5 N, which arrives 13.7 ms after 0.5 s.
    Scene scene(R"toml(name = "block"
[sampling]
period = 0.01
[signals]
F = { unit = "N", hold = "zoh" }
v = { unit = "m/s", initial = 0 }
[parameters]
m = { unit = "kg", initial = 2 }
Fc = { unit = "N", initial = 3 }
[[equation]]
ode = "m*der(v) = delay(F, 0.0137) - Fc*sgn(v)"
)toml");
    const FreeRun run = scene.run(101, {{"F", [](double t) { return t < 0.495 ? 2.0 : 5.0; }}});
    for (std::size_t k = 0; k <= 100; ++k) {
        const double t = period * static_cast<double>(k);
        REQUIRE(scene.of(run, "v")[k] == Approx(std::max(t - 0.5137, 0.0)).margin(1e-7));
    }
}

TEST_CASE("delay: a law sees what moves, and its own output, some time ago") {
    // x' = u, u = -5 x(t_k - 0.025) + 0.3 u(t_k - 0.01), held: between samples x is straight.
    Scene scene(R"toml(name = "loop"
[sampling]
period = 0.01
[signals]
u = { unit = "m/s", hold = "zoh" }
x = { unit = "m", initial = 1 }
[constants]
K = { unit = "1/s", value = 5 }
[parameters]
g = { unit = "1", initial = 1 }
[[equation]]
ode = "der(x) = g*u"
[[feedback]]
signal = "u"
law = "-K*delay(x, 0.025) + 0.3*delay(u, 0.01)"
)toml");
    const FreeRun run = scene.run(200, {{"u", step}});
    std::vector<double> x = {1.0};
    std::vector<double> u;
    for (std::size_t k = 0; k < 200; ++k) {
        const double ago = k < 3 ? x[0] : 0.5 * (x[k - 3] + x[k - 2]);
        u.push_back(-5 * ago + 0.3 * (k > 0 ? u[k - 1] : 0.0));
        x.push_back(x.back() + period * u.back());
        REQUIRE(scene.of(run, "u")[k] == Approx(u[k]).margin(1e-8));
        REQUIRE(scene.of(run, "x")[k] == Approx(x[k]).margin(1e-8));
    }
}

TEST_CASE("delay: what moves is not delayed in an equation of motion") {
    Scene scene("name = \"m\"\n[sampling]\nperiod = 1\n[signals]\nx = { unit = \"m\" }\n[parameters]\na = { unit = \"1/s\", initial = 1 }\n[[equation]]\node = \"der(x) = -a*delay(x, 2)\"\n");
    const auto said = scene.refusal();
    CHECK((said.at.line == 9 && said.at.column == 20));
    CHECK(said.what.find("a delay equation cannot be simulated") != std::string::npos);
}

TEST_CASE("delay: a fit finds it") {
    Scene scene(lag("zoh", "delay(u, tau)"));
    const std::vector<double> answer = lagging_answer(400);
    const auto recording = scene.recorded(400, {{"u", step}, {"x", [&](double t) { return answer[static_cast<std::size_t>(std::lround(t / period))]; }}});
    const auto bench = algest::lab::bench(scene.model, recording, scene.diagnostics);
    REQUIRE(bench);
    const auto found = algest::lab::fit(scene.model, *bench, {{3.0, 3.0, 0.025}, {}, bench->initial, {0, 400}});
    CHECK(found.parameters[0] == Approx(2.0).epsilon(1e-4));   // the fit stops at a relative change of 1e-7 of the cost
    CHECK(found.parameters[2] == Approx(0.0137).epsilon(1e-4));
}

TEST_CASE("delay: rows of the weak form vanish where the delay is right") {
    // x' = u(t - 0.03) with u linear between samples, so x is a chain of parabolas: the rows' own error is that of x held linearly.
    const auto rows = [](const std::string& tau) {
        Scene scene("name = \"m\"\n[sampling]\nperiod = 0.01\n[signals]\nu = { unit = \"m/s\" }\nx = { unit = \"m\" }\n[parameters]\ng = { unit = \"1\", initial = 1 }\n[[equation]]\node = \"der(x) = g*delay(u, " + tau + ")\"\n");
        const auto u = [](double t) { return std::sin(7 * t); };
        const auto x = [](double t) { return t < 0.03 ? 0.0 : (1 - std::cos(7 * (t - 0.03))) / 7; };
        const auto recording = scene.recorded(600, {{"u", u}, {"x", x}});
        const auto bench = algest::lab::bench(scene.model, recording, scene.diagnostics);
        REQUIRE(bench);
        const auto form = algest::lab::weak_form(scene.model, *bench, 0, {0, 600}, 32);
        REQUIRE(form);
        return algest::lab::weak_residual(*form, {1.0}).norm() / (form->columns.col(0).norm() + form->columns.col(1).norm());
    };
    CHECK(rows("0.03") < 3e-4);        // (7 * 0.01)^2 / 12 of a straight line for a sine
    CHECK(rows("0.025") == Approx(rows("0.035")).epsilon(0.1));   // half a sample too early, half a sample too late
    CHECK(rows("0.025") > 30 * rows("0.03"));
    CHECK(rows("0.02") > 1.8 * rows("0.025"));
}

TEST_CASE("delay: the past of a run is cubic between samples") {
    // x = t^3 at 0, 1, 2 s: any three-quarter sample is exact; before the first sample its value.
    const algest::lab::MovingPast past = {{1, 2, 9}, {0, 3, 12}, {0, 3}};   // 1 + t^3
    for (const double ago : {0.0, 0.25, 1.0, 1.6, 2.0}) CHECK(algest::lab::past_value(past, algest::lab::samples_ago(ago * 0.01, 0.01)) == Approx(1 + std::pow(2 - ago, 3)).epsilon(1e-12));
    CHECK(algest::lab::past_value(past, algest::lab::samples_ago(5, 1)) == 1);
}
