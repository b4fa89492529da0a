// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 4 of issue 6 by linear least squares: a DC motor at one speed tells resistance, but not viscous friction from dry. The blocks in which it
// still creeps towards that speed pass for others, and their inertia for friction.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "lab/operating_points.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

constexpr double period = 1e-3;
constexpr double R = 1.7, L = 2e-3, K = 0.062, J = 1.2e-4, b = 3.1e-4, T_c = 0.012;
const std::vector<double> truth = {R, b, T_c};

std::string model(const std::string& noise_i, const std::string& noise_w, const std::string& steady = "0.2") {
    return fmt::format(R"toml(format = 1
name = "levels"
[sampling]
period = 1e-3
window = 0.1
[signals]
u = {{ unit = "V", hold = "zoh" }}
i = {{ unit = "A", steady = 0.02{} }}
w = {{ unit = "rad/s", steady = {}{} }}
[constants]
K = {{ value = 0.062, unit = "N.m/A" }}
[parameters]
R = {{ unit = "ohm", initial = 1 }}
b = {{ unit = "N.m.s/rad", initial = 1e-4 }}
Tc = {{ unit = "N.m", initial = 0.01 }}
[[equation]]
name = "voltage"
ode = "0 = u - R*i - K*w"
[[equation]]
name = "torque"
ode = "0 = K*i - b*w - Tc*sgn(w)"
[estimator]
functional = "average"
solve = "least_squares"
)toml",
                       noise_i, steady, noise_w);
}

/// u, i, w: each voltage for 0.6 s, from rest.
std::vector<std::vector<double>> run(const std::vector<double>& volts) {
    std::vector<std::vector<double>> out;
    double i = 0.0, w = 0.0;
    constexpr int steps = 20;
    for (const double u : volts) {
        for (int k = 0; k < 600; ++k) {
            out.push_back({u, i, w});
            for (int s = 0; s < steps; ++s) {   // midpoint rule: 5e-5 s against 1.2 ms
                const auto slope = [&](double at_i, double at_w) { return std::pair((u - R * at_i - K * at_w) / L, (K * at_i - b * at_w - T_c * std::tanh(at_w / 0.05)) / J); };
                const auto first = slope(i, w);
                const auto middle = slope(i + 0.5 * period / steps * first.first, w + 0.5 * period / steps * first.second);
                i += period / steps * middle.first;
                w += period / steps * middle.second;
            }
        }
    }
    return out;
}

std::vector<std::vector<double>> noisy(std::vector<std::vector<double>> samples, unsigned seed) {
    std::mt19937 bits(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    for (auto& s : samples) {
        s[1] += 0.02 * normal(bits);
        s[2] += 0.2 * normal(bits);
    }
    return samples;
}

}  // namespace

TEST_CASE("one speed: no numbers, with noise and without, over 200 seeds; several voltages have them") {
    const std::vector<std::vector<double>> one = run({6, 6, 6, 6});
    const std::vector<std::vector<double>> several = run({3, 6, 9, 12, -4, -8, -11});
    for (const bool declared : {false, true}) {
        const plan::Plan plan = declared ? plan_of(model(", noise = 0.02", ", noise = 0.2")) : plan_of(model("", ""));
        for (const Estimate& e : estimates(plan, one)) CHECK(e.status != Status::ok);
        long ok = 0;
        std::vector<double> worst;
        for (unsigned seed = 1; seed <= 200; ++seed) {
            for (const Estimate& e : estimates(plan, noisy(one, seed))) ok += e.status == Status::ok ? 1 : 0;
            const Estimate e = estimates(plan, noisy(several, seed)).back();
            REQUIRE(e.status == Status::ok);
            worst.push_back(worst_error(e.parameters, truth));
        }
        fmt::print("one speed, noise {}: {} samples ok of 200 runs; several: ok in all, worst error of R, b, Tc: median {:.3f}\n", declared ? "declared" : "not declared", ok, median(worst));
        CHECK(ok == 0);
        // Means of 100 samples have 2 mA and 0.02 rad/s: 0.13 mN.m of 12 mN.m in each of a dozen points.
        CHECK(median(worst) < 0.03);
    }
}

TEST_CASE("one speed: without a tolerance and without noise nobody knows, and the rank test decides as before") {
    const plan::Plan plan = plan_of(model("", "", "0.2").replace(model("", "").find("steady = 0.02"), 13, "min = -100"));
    CHECK(plan.margin_over_noise > 0.0);   // w still has one
    CHECK(plan_of(model("", "").replace(model("", "").find("[estimator]"), 11, "[estimator]\nuncertainty = false")).margin_over_noise == 0.0);
}
