// SPDX-License-Identifier: GPL-3.0-or-later
// Free runs of equations that differentiate their input, against partial fractions: of b2 + r1/(s+p1) + r2/(s+p2) each part is a lag of first
// order, which a held or straight input moves in closed form.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "tests/lab/scene.hpp"

namespace {

using algest::lab::FreeRun;
using algest::test::Scene;

constexpr double period = 0.05;
constexpr std::size_t samples = 60;

double wave(double t) { return (std::fmod(t + 1e-9, 0.7) < 0.3 ? 1.5 : -1.0) + 0.3 * std::sin(3 * t); }

double at(std::size_t k) { return wave(period * static_cast<double>(k)); }

/// z' = -p z + r u over the period from sample k on.
double lag(double z, double p, double r, std::size_t k, bool held) {
    const double decay = std::exp(-p * period);
    const double slope = held ? 0.0 : (at(k + 1) - at(k)) / period;
    return z * decay + r * (at(k) * (1 - decay) / p + slope * (period - (1 - decay) / p) / p);
}

}  // namespace

TEST_CASE("free run: an input differentiated once is passed on at once, held or straight") {
    const std::string hold = GENERATE("zoh", "linear");
    const std::string ode = GENERATE("der(y) + a*y = b*der(u) + c*u", "der(u) + c/b*u = (der(y) + a*y)/b");
    if (hold == "linear" && ode[4] == 'u') return;   // that would be an equation of u
    Scene scene(fmt::format(R"toml(name = "lead"
[sampling]
period = 0.05
[signals]
y = {{ unit = "V", initial = 0.4 }}
u = {{ unit = "V", hold = "{}" }}
[parameters]
a = {{ unit = "1/s", initial = 2 }}
b = {{ unit = "1", initial = 3 }}
c = {{ unit = "1/s", initial = 5 }}
[[equation]]
ode = "{}"
)toml", hold, ode));
    const FreeRun run = scene.run(samples, {{"u", wave}});
    double z = 0.4 - 3 * at(0);   // 3 + (5 - 3 2)/(s + 2)
    for (std::size_t k = 0; k < samples; ++k) {
        INFO(k);
        CHECK(scene.of(run, "y")[k] == Approx(z + 3 * at(k)).epsilon(0).margin(1e-6));   // 60 steps of local error 1e-8 of a size of 5
        if (k + 1 < samples) z = lag(z, 2, -1, k, hold == "zoh");
    }
}

TEST_CASE("free run: a transfer equation with m = n, and with m = n - 1") {
    const std::string hold = GENERATE("zoh", "linear");
    const double b2 = GENERATE(0.0, 0.7);
    Scene scene(fmt::format(R"toml(name = "zeros"
[sampling]
period = 0.05
[signals]
y = {{ unit = "1", initial = 0.4 }}
u = {{ unit = "1", hold = "{}" }}
[transfer]
n = 2
m = 2
unknowns = ["a0", "a1", "b0", "b1"]
known = {{ b2 = {} }}
[parameters]
a0 = {{ initial = 2 }}
a1 = {{ initial = 3 }}
b0 = {{ initial = 4 }}
b1 = {{ initial = -1 }}
)toml", hold, b2));
    const FreeRun run = scene.run(samples, {{"u", wave}});
    // (b2 s^2 - s + 4)/((s + 1)(s + 2)): residues by covering up
    const double r1 = b2 + 1 + 4;
    const double r2 = -(4 * b2 + 2 + 4);
    // at the first sample y = 0.4 and y' = 0; a straight input has a slope there
    const double slope = hold == "zoh" ? 0.0 : (at(1) - at(0)) / period;
    const double sum = 0.4 - b2 * at(0);
    double z2 = -sum + (r1 + r2) * at(0) + b2 * slope;   // of y' = -z1 - 2 z2 + (r1 + r2) u + b2 u'
    double z1 = sum - z2;
    for (std::size_t k = 0; k < samples; ++k) {
        INFO(k);
        CHECK(scene.of(run, "y")[k] == Approx(z1 + z2 + b2 * at(k)).epsilon(0).margin(1e-6));
        if (k + 1 == samples) break;
        z1 = lag(z1, 1, r1, k, hold == "zoh");
        z2 = lag(z2, 2, r2, k, hold == "zoh");
    }
}

TEST_CASE("free run: what jumps with a held input makes others jump") {
    Scene scene(R"toml(name = "chain"
[sampling]
period = 0.05
[signals]
u = { unit = "1", hold = "zoh" }
y1 = { unit = "1", initial = 0 }
y2 = { unit = "1", initial = 0 }
[parameters]
T = { unit = "s", initial = 1 }
[[equation]]
ode = "T*der(y2) + y2 = T*der(y1)"
[[equation]]
ode = "T*der(y1) + y1 = T*der(u)"
)toml");
    const FreeRun run = scene.run(samples, {{"u", wave}});
    // y1 = u - q1, y2 = u - 2 q1 + q2 with q1' = u - q1, q2' = q1 - q2
    double q1 = at(0);
    double q2 = at(0);
    const double decay = std::exp(-period);
    for (std::size_t k = 0; k < samples; ++k) {
        INFO(k);
        CHECK(scene.of(run, "y1")[k] == Approx(at(k) - q1).epsilon(0).margin(1e-6));
        CHECK(scene.of(run, "y2")[k] == Approx(at(k) - 2 * q1 + q2).epsilon(0).margin(1e-6));
        q2 = at(k) + decay * (q2 - at(k) + period * (q1 - at(k)));
        q1 = at(k) + decay * (q1 - at(k));
    }
}

TEST_CASE("free run: the slope of a straight input may stand anywhere, a jump may not") {
    const auto model = [](const std::string& hold, const std::string& ode, const std::string& more = "") {
        return fmt::format(R"toml(name = "m"
[sampling]
period = 0.05
[signals]
u = {{ hold = "{}" }}
x = {{ initial = 1 }}
[parameters]
a = {{ initial = 2 }}
[[equation]]
ode = "{}"
{})toml", hold, ode, more);
    };
    Scene sound(model("linear", "der(x) = a*x*der(u)"));
    const FreeRun run = sound.run(samples, {{"u", wave}});
    for (std::size_t k = 0; k < samples; ++k) CHECK(sound.of(run, "x")[k] == Approx(std::exp(2 * (at(k) - at(0)))).margin(1e-6));

    const auto moving = Scene(model("zoh", "der(x) = a*x*der(u)")).refusal();
    CHECK(moving.at.line == 10);
    CHECK(moving.what.find("factor that moves") != std::string::npos);
    const auto set = Scene(model("zoh", "der(x) = a*der(u)", "[[feedback]]\nsignal = \"u\"\nlaw = \"-x\"\n")).refusal();
    CHECK(set.at.line == 5);
    CHECK(set.what.find("a law sets it") != std::string::npos);
    const auto impulse = Scene(R"toml(name = "m"
[sampling]
period = 0.05
[signals]
u = { hold = "zoh" }
x = {}
y = {}
[parameters]
a = { initial = 2 }
[[equation]]
ode = "der(x,2) + a*der(x) = der(u,2)"
[[equation]]
ode = "der(y) = der(x,2) - y"
)toml").refusal();
    CHECK(impulse.at.line == 13);
    CHECK(impulse.what.find("'y' out to infinity") != std::string::npos);
}
