// SPDX-License-Identifier: GPL-3.0-or-later
// Free runs against closed solutions.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/lab/scene.hpp"

namespace {

using algest::lab::FreeRun;
using algest::test::Scene;

}  // namespace

TEST_CASE("free run: a held input gives the exact exponential at every sample") {
    Scene scene(R"toml(name = "coil"
[sampling]
period = 1e-3
[signals]
v = { unit = "V", hold = "zoh" }
i = { unit = "A", initial = 0.5 }
[parameters]
R = { unit = "ohm", initial = 2 }
L = { unit = "H", initial = 0.05 }
[[equation]]
ode = "L*der(i) = v - R*i"
)toml");
    const auto v = [](double t) { return t < 0.0995 ? 3.0 : -1.0; };
    const FreeRun run = scene.run(300, {{"v", v}});
    double i = 0.5;
    const double decay = std::exp(-2.0 / 0.05 * 1e-3);
    for (std::size_t k = 0; k < 300; ++k) {
        CHECK(scene.of(run, "i")[k] == Approx(i).epsilon(0).margin(1e-13));   // one exact step a sample: the rounding of 300, on both sides
        i = decay * i + (1 - decay) * v(static_cast<double>(k) * 1e-3) / 2.0;
    }
}

TEST_CASE("free run: a linear hold follows a ramp exactly") {
    Scene scene(R"toml(name = "lag"
[sampling]
period = "0.01"
[signals]
u = { unit = "1" }
x = { unit = "1", initial = 0 }
[parameters]
T = { unit = "s", initial = 0.3 }
[[equation]]
ode = "T*der(x) = u - x"
)toml");
    const FreeRun run = scene.run(200, {{"u", [](double t) { return t; }}});
    for (std::size_t k = 0; k < 200; ++k) {
        const double t = 0.01 * static_cast<double>(k);
        CHECK(scene.of(run, "x")[k] == Approx(t - 0.3 * (1 - std::exp(-t / 0.3))).epsilon(0).margin(1e-13));
    }
}

TEST_CASE("free run: dry friction stops a sliding mass and holds it until the force is larger") {
    // However its sgn() is written, and on a belt too: there the same happens relative to it.
    const auto [friction, belt] = GENERATE(table<std::string, double>({{"- Fc*sgn(v)", 0.0},
                                                                      {"+ Fc*sgn(-v)", 0.0},
                                                                      {"- Fc*sgn(2*v)", 0.0},
                                                                      {"- Fc*sgn(v/k - 0)", 0.0},
                                                                      {"- 0.4*Fc*sgn(v) + 0.6*Fc*sgn(-3*v)", 0.0},
                                                                      {"- Fc*sgn(v - vb)", 0.4},
                                                                      {"+ Fc*sgn(k*(vp - v))", 0.4},
                                                                      {"- 0.4*Fc*sgn(v - vb) + 0.6*Fc*sgn(2*vb - 2*v)", 0.4}}));
    INFO(friction);
    Scene scene(fmt::format(R"toml(name = "block"
[sampling]
period = 1e-3
[signals]
F = {{ unit = "N", hold = "zoh" }}
x = {{ unit = "m", initial = 0 }}
v = {{ unit = "m/s", initial = {} }}
[constants]
k = {{ value = 2, unit = "1" }}
vb = {{ value = 0.4, unit = "m/s" }}
[parameters]
m = {{ unit = "kg", initial = 2 }}
Fc = {{ unit = "N", initial = 3 }}
vp = {{ unit = "m/s", initial = 0.4 }}
[[equation]]
ode = "der(x) = v"
[[equation]]
ode = "m*der(v) = F {}"
)toml", belt + 0.9, friction));
    // No force: stops at m v0 / Fc = 0.6 s after m v0^2 / (2 Fc) = 0.27 m. From 1 s: 2.9 N, too small. From 1.5 s: -5 N.
    const FreeRun run = scene.run(2001, {{"F", [](double t) { return t < 0.9995 ? 0.0 : t < 1.4995 ? 2.9 : -5.0; }}});
    REQUIRE(run.samples == 2001);
    const auto& v = scene.of(run, "v");
    const auto& x = scene.of(run, "x");
    for (std::size_t k = 0; k <= 2000; ++k) {
        const double t = 1e-3 * static_cast<double>(k);
        const double sliding = std::max(0.6 - t, 0.0);
        const double pushed = std::max(t - 1.5, 0.0);
        const double expected_v = belt + 1.5 * sliding - 1.0 * pushed;              // (F + Fc)/m = -1 m/s^2
        const double expected_x = belt * t + 0.27 - 0.75 * sliding * sliding - 0.5 * pushed * pushed;
        CHECK(v[k] == Approx(expected_v).margin(1e-7));
        CHECK(x[k] == Approx(expected_x).margin(1e-7));
    }
}

TEST_CASE("free run: a swinging pendulum keeps its energy") {
    Scene scene(R"toml(name = "swing"
[sampling]
period = "0.01"
[signals]
th = { unit = "rad", initial = 2 }
w = { unit = "rad/s", initial = 0 }
[parameters]
g = { unit = "1/s^2", initial = 64 }
[[equation]]
ode = "der(th) = w"
[[equation]]
ode = "der(w) = -g*sin(th)"
)toml");
    const FreeRun run = scene.run(1000, {});
    const auto energy = [&](std::size_t k) { return 0.5 * std::pow(scene.of(run, "w")[k], 2) - 64 * std::cos(scene.of(run, "th")[k]); };
    for (std::size_t k = 0; k < 1000; ++k) CHECK(energy(k) == Approx(energy(0)).epsilon(1e-6));   // about 13 swings
}

TEST_CASE("free run: a control law is sampled once a period and held") {
    Scene scene(R"toml(name = "unstable"
[sampling]
period = "0.01"
[signals]
r = { unit = "1", hold = "zoh" }
u = { unit = "1", hold = "zoh" }
x = { unit = "1", initial = 0.2 }
[constants]
k = { value = 12, unit = "1" }
[parameters]
a = { unit = "1/s", initial = 5 }
[[equation]]
ode = "der(x) = a*x + a*u"
[[feedback]]
signal = "u"
law = "k*(r - x)"
)toml");
    const FreeRun run = scene.run(300, {{"r", [](double t) { return std::sin(3 * t); }}, {"u", [](double) { return 99.0; }}});
    double x = 0.2;
    const double growth = std::exp(5 * 0.01);
    for (std::size_t k = 0; k < 300; ++k) {
        CHECK(scene.of(run, "x")[k] == Approx(x).margin(1e-7));
        const double u = 12 * (std::sin(3 * 0.01 * static_cast<double>(k)) - x);
        CHECK(scene.of(run, "u")[k] == Approx(u).margin(2e-6));
        x = growth * x + (growth - 1) * u;
    }
}

TEST_CASE("free run: an unstable plant without its law diverges and says where") {
    Scene scene(R"toml(name = "runaway"
[sampling]
period = "0.01"
[signals]
x = { unit = "1", initial = 1 }
[parameters]
a = { unit = "1/s", initial = 10 }
[[equation]]
ode = "der(x) = a*x"
)toml");
    const FreeRun run = scene.run(1000, {});
    // exp(10 t) passes 1e6 at t = 1.38 s; nothing is measured, so the scale of x is 1.
    CHECK(run.samples >= 138);
    CHECK(run.samples <= 140);
}

TEST_CASE("free run: a hidden pressure in Pa is no divergence, at rest or on its way, declared or not") {
    const auto [declared, start] = GENERATE(table<std::string, double>({{", initial = 2e6", 2e6}, {", initial = 0", 0.0}, {"", 0.0}}));
    INFO(declared);
    Scene scene(fmt::format(R"toml(name = "accumulator"
[sampling]
period = 1e-2
[signals]
ps = {{ unit = "Pa", hold = "zoh" }}
p = {{ unit = "Pa"{} }}
[parameters]
T = {{ unit = "s", initial = 0.1 }}
[[equation]]
ode = "T*der(p) = ps - p"
)toml", declared));
    const FreeRun run = scene.run(101, {{"ps", [](double) { return 2e6; }}});
    REQUIRE(run.samples == 101);
    for (std::size_t k = 0; k <= 100; ++k) CHECK(scene.of(run, "p")[k] == Approx(2e6 + (start - 2e6) * std::exp(-0.1 * static_cast<double>(k))).epsilon(1e-6));
}

TEST_CASE("free run: coupled highest derivatives are solved together") {
    Scene scene(R"toml(name = "coupled"
[sampling]
period = "0.01"
[signals]
x = { unit = "1", initial = 1 }
y = { unit = "1", initial = 0 }
[parameters]
T = { unit = "s", initial = 1 }
c = { unit = "s", initial = 0.5 }
[[equation]]
ode = "T*der(x) + c*der(y) = -x"
[[equation]]
ode = "T*der(y) + c*der(x) = -y"
)toml");
    // s = x + y and d = x - y: (T+c) s' = -s, (T-c) d' = -d.
    const FreeRun run = scene.run(200, {});
    for (std::size_t k = 0; k < 200; ++k) {
        const double t = 0.01 * static_cast<double>(k);
        const double s = std::exp(-t / 1.5), d = std::exp(-t / 0.5);
        CHECK(scene.of(run, "x")[k] == Approx(0.5 * (s + d)).margin(1e-7));
        CHECK(scene.of(run, "y")[k] == Approx(0.5 * (s - d)).margin(1e-7));
    }
}
