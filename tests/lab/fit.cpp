// SPDX-License-Identifier: GPL-3.0-or-later
// Free-run output error on machines whose answer has a closed form.
#include "lab/fit.hpp"

#include <cmath>
#include <random>

#include "tests/lab/scene.hpp"

using namespace algest;
using algest::lab::Rows;
using algest::test::Scene;

namespace {

constexpr std::size_t samples = 1001;
constexpr double noise_of_x = 0.02;

/// x' = -a x + u with u = 1, x(0) = 3, a = 2:  x = 1/2 + 5/2 exp(-2t).
std::string cooling(const std::string& of_a) {
    return "name = \"cooling\"\n[sampling]\nperiod = 2e-3\n[signals]\nu = { unit = \"K/s\", hold = \"zoh\" }\nx = { unit = \"K\", noise = 0.02 }\n[parameters]\n"
           "a = { unit = \"1/s\", " + of_a + " }\nunseen = { unit = \"1\", initial = 4 }\n[[equation]]\node = \"der(x) = u - a*x + 0*unseen*x*a\"\n";
}
double answer(double t) { return 0.5 + 2.5 * std::exp(-2 * t); }

lab::Fit fitted(const std::string& of_a, double noise, unsigned seed, std::vector<double> from = {1.0, 4.0}) {
    Scene scene(cooling(of_a));
    std::mt19937 random(seed);
    std::normal_distribution<double> white(0.0, 1.0);
    const auto recording = scene.recorded(samples, {{"u", [](double) { return 1.0; }}, {"x", [&](double t) { return answer(t) + noise * white(random); }}});
    const auto bench = lab::bench(scene.model, recording, scene.diagnostics);
    REQUIRE(bench);
    return lab::fit(scene.model, *bench, {std::move(from), {}, bench->initial, Rows{0, samples}});
}

}  // namespace

TEST_CASE("fit: parameter and initial value of a closed-form answer; what is not seen stays, with an infinite deviation") {
    const lab::Fit f = fitted("initial = 1", 0.0, 1);
    CHECK(f.converged);
    CHECK(f.parameters[0] == Approx(2.0).epsilon(1e-5));   // tolerance 1e-7 of the cost, that is 3e-4 of a step, quadratic at the end
    CHECK(f.initial[0] == Approx(3.0).epsilon(1e-5));
    CHECK(f.parameters[1] == 4.0);
    CHECK(std::isinf(f.sd[1]));
}

TEST_CASE("fit: bounds hold") {
    CHECK(fitted("initial = 1, min = 0.5, max = 1.5", 0.0, 1).parameters[0] == Approx(1.5));
    CHECK(fitted("initial = 3, min = 2.5, max = 4", 0.0, 1, {3.0, 4.0}).parameters[0] == Approx(2.5));
}

TEST_CASE("fit: its deviation is that of the linearised closed form, and of repeated draws") {
    // Slopes of x by a and by x(0): Cramer-Rao by hand.
    double aa = 0, ab = 0, bb = 0;
    for (std::size_t k = 0; k < samples; ++k) {
        const double t = 2e-3 * static_cast<double>(k), e = std::exp(-2 * t);
        // x = u/a + (x0 - u/a) exp(-a t)
        const double by_a = -0.25 + 0.25 * e - 2.5 * t * e;
        aa += by_a * by_a;
        ab += by_a * e;
        bb += e * e;
    }
    const double bound = noise_of_x / std::sqrt(aa - ab * ab / bb);
    double squares = 0, said = 0;
    constexpr int draws = 60;
    for (unsigned seed = 1; seed <= draws; ++seed) {
        const lab::Fit f = fitted("initial = 1", noise_of_x, seed);
        squares += (f.parameters[0] - 2.0) * (f.parameters[0] - 2.0);
        said += f.sd[0] / draws;
    }
    CHECK(std::sqrt(squares / draws) == Approx(bound).epsilon(0.37));   // 60 draws: 9 percent, four of those
    CHECK(said > 0.9 * bound);    // enlarged by chance autocorrelation, never made smaller than its own draw's noise (some percent)
    CHECK(said < 1.6 * bound);
}

TEST_CASE("fit: rows that count as one are those of a first-order process") {
    std::mt19937 random(9);
    std::normal_distribution<double> white;
    std::vector<double> independent, coloured;
    double x = 0;
    for (int k = 0; k < 100000; ++k) {
        const double e = white(random);
        independent.push_back(e);
        coloured.push_back(x = 0.8 * x + e);
    }
    // Sum of 0.8^|k|: (1 + 0.8)/(1 - 0.8) = 9. Up to the first zero of an estimated autocorrelation: chance adds some percent.
    CHECK(lab::rows_that_count_as_one(coloured.data(), coloured.size()) == Approx(9.0).epsilon(0.15));
    CHECK(lab::rows_that_count_as_one(independent.data(), independent.size()) == Approx(1.0).epsilon(0.05));
}

TEST_CASE("fit: outputs are compared in the order of the model, a sensor that shows another signal among them") {
    Scene scene("name = \"m\"\n[sampling]\nperiod = 1e-2\n[signals]\nu = { unit = \"V\", hold = \"zoh\" }\ny = { unit = \"m\" }\nx = { unit = \"m\", initial = 0 }\nz = { unit = \"m\", initial = 0 }\n[parameters]\n"
                "a = { unit = \"1/s\", initial = 1 }\n[[equation]]\node = \"der(x) = -a*x\"\n[[equation]]\node = \"der(z) = -a*z\"\n[[equation]]\node = \"y = abs(z)\"\n");
    const auto one = [](double) { return 1.0; };
    const auto recording = scene.recorded(200, {{"u", one}, {"y", one}, {"x", one}});
    const auto bench = lab::bench(scene.model, recording, scene.diagnostics);
    REQUIRE(bench);
    CHECK(lab::scored_outputs(scene.model, *bench) == std::vector<int>{scene.model.signal_index("y"), scene.model.signal_index("x")});   // x is a state, y an output
}
