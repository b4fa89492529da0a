// SPDX-License-Identifier: GPL-3.0-or-later
// The yardstick of a gap: what is declared, else the roughness of the signal.
#include "lab/noise.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "lab/recording_doubts.hpp"
#include "tests/lab/scene.hpp"
#include "tests/lab/workplace.hpp"

using namespace algest;
using algest::test::Scene;

TEST_CASE("noise: third differences see white noise, and no smooth signal") {
    std::vector<double> smooth, noisy;
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 0.01);
    for (int k = 0; k < 20000; ++k) {
        smooth.push_back(std::sin(0.01 * k));
        noisy.push_back(smooth.back() + noise(random));
    }
    CHECK(lab::roughness(smooth) < 1e-6 / std::sqrt(20.0) * 1.001);   // the third difference of sin(wk) is below w^3 = 1e-6
    CHECK(lab::roughness(noisy) == Approx(0.01).epsilon(0.04));       // overlapping third differences: about 1 percent, four of those
    CHECK(lab::roughness({1.0, 5.0, -3.0}) == 0);
}

TEST_CASE("noise: declared noise and the rounding of a converter add up by their squares; noise = 0 declares nothing") {
    Scene scene(R"toml(name = "two"
[sampling]
period = 1e-3
[signals]
u = { unit = "V" }
a = { unit = "1", noise = 0.3, initial = 0 }
b = { unit = "1", noise = 0.3, resolution = 1.2, initial = 0 }
c = { unit = "1", noise = 0, initial = 0 }
[parameters]
p = { unit = "V-1.s-1", initial = 1 }
[[equation]]
ode = "der(a) = p*u"
[[equation]]
ode = "der(b) = p*u"
[[equation]]
ode = "der(c) = p*u"
)toml");
    const auto alternating = [](double t) { return std::lround(1000 * t) % 2 == 0 ? 1.0 : -1.0; };
    const auto recording = scene.recorded(1000, {{"u", alternating}, {"a", alternating}, {"b", alternating}, {"c", alternating}});
    const auto bench = lab::bench(scene.model, recording, scene.diagnostics);
    REQUIRE(bench);
    const std::vector<double> noise = lab::noise_by_signal(scene.model, *bench);
    CHECK(noise[0] == 0);                                              // an input has none of its own
    CHECK(noise[1] == Approx(0.3));
    CHECK(noise[2] == Approx(std::sqrt(0.09 + 1.44 / 12)));            // uniform over a step
    CHECK(noise[3] == Approx(8 / std::sqrt(20.0)));                    // rough: third differences of +-1 are +-8
    CHECK_FALSE(lab::declares_noise(*scene.model.signal("c")));
}

TEST_CASE("noise: what is declared far above the roughness of a signal is doubted, for effects hide below it") {
    const auto nothing = [](std::size_t, double) { return 0.0; };
    const auto said = [](const test::Workplace& w) {
        const auto doubts = lab::recording_doubts(w.nominal->model, w.nominal->bench);
        return std::any_of(doubts.begin(), doubts.end(), [](const std::string& d) { return d.find("times smoother than the noise that it declares") != std::string::npos; });
    };
    CHECK(said(test::Workplace(nothing, 1e-3, "noise = 1e-2, initial = 0")));
    CHECK_FALSE(said(test::Workplace(nothing, 1e-3)));
}
