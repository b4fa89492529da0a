// SPDX-License-Identifier: GPL-3.0-or-later
// The ratio filter (000, equation 43): against numerator and denominator through the differential equation, and on the noisy PMSM.
#include <fmt/format.h>

#include "tests/lab/plans.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/coverage.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("numerator and denominator go through the low-pass one by one; a silent stretch has no weight") {
    // G mean(y) = mean(u) over three samples, S(t) over three instants: D = sum of squares of means of y, N = sum of products.
    const std::string text = R"(format = 1
name = "conductance"
[sampling]
period = 0.25
window = 0.5
[signals]
y = { unit = "V" }
u = { unit = "A" }
[parameters]
G = { unit = "1/ohm", initial = 7 }
[[equation]]
ode = "u = G*y"
rows = 1
[estimator]
solve = "robust"
solve_window = 0.5
)";
    const plan::Plan plain = plan_of(text);
    const plan::Plan filtered = plan_of(text + "ratio_filter = { omega_n = 2, zeta = 0.5 }\n");
    lab::HostEstimator<double> one(plain), other(filtered);
    const auto& weights = plain.tables.at(0).weights;
    std::vector<double> y, u, P, Q;
    std::array<std::array<double, 2>, 2> x{};   // of N and of D: value, slope/omega_n
    std::array<double, 2> before{};
    bool first = true;
    int compared = 0;
    for (int k = 0; k < 60; ++k) {
        y.push_back(k >= 20 && k < 30 ? 1e-3 : 2.0 + std::sin(0.7 * k));
        u.push_back((3.0 + 0.1 * (k % 5)) * y.back());
        one.step(std::array<double, 2>{y.back(), u.back()}.data());
        other.step(std::array<double, 2>{y.back(), u.back()}.data());
        if (k < 2) continue;
        const std::size_t at = static_cast<std::size_t>(k);
        P.push_back(weights[0] * y[at - 2] + weights[1] * y[at - 1] + weights[2] * y[at]);
        Q.push_back(weights[0] * u[at - 2] + weights[1] * u[at - 1] + weights[2] * u[at]);
        if (P.size() < 3) continue;
        std::array<double, 2> input{};
        for (std::size_t j = P.size() - 3; j < P.size(); ++j) {
            input[0] += P[j] * Q[j];
            input[1] += P[j] * P[j];
        }
        for (std::size_t s = 0; s < 2; ++s) {
            if (first) x[s] = {input[s], 0.0};
            else {
                advance(x[s], 0.0, 0.25, [&](const auto& state, auto& rate, double t) {
                    const double now = before[s] + (input[s] - before[s]) * t / 0.25;
                    rate[0] = 2.0 * state[1];
                    rate[1] = 2.0 * (now - state[0]) - 2.0 * 0.5 * 2.0 * state[1];
                });
            }
        }
        first = false;
        before = input;
        REQUIRE(one.status() == Status::ok);
        CHECK(one.parameters()[0] == Approx(input[0] / input[1]).epsilon(1e-12));
        if (x[1][0] <= 0.0) continue;   // an underdamped low-pass swings below 0 where the signal falls silent: singular
        REQUIRE(other.status() == Status::ok);
        CHECK(other.parameters()[0] == Approx(x[0][0] / x[1][0]).epsilon(1e-6));   // the ODE library's 1e-9, on a quotient
        ++compared;
    }
    CHECK(compared > 40);
}

TEST_CASE("PMSM with noise: the ratio filter takes a part of it, and none of the truth") {
    Pmsm motor;
    const plan::Plan plain = plan_of(pmsm_model("robust"));
    const plan::Plan filtered = plan_of(pmsm_model("robust") + "ratio_filter = { omega_n = 15, zeta = 0.707 }\n");   // 000
    const std::array<double, 3> truth{motor.R, motor.L, motor.K};
    const auto ideal = estimates(filtered, inputs(simulate(motor, 8001)));
    for (std::size_t p = 0; p < 3; ++p) CHECK(worst(errors(ideal, 4000, p, truth[p])) < 1e-4);   // the bar of errata.md

    motor.current_noise = 0.03;
    double before = 0.0, after = 0.0;
    for (motor.seed = 1; motor.seed <= 5; ++motor.seed) {
        const auto samples = inputs(simulate(motor, 8001));
        const auto a = estimates(plain, samples), b = estimates(filtered, samples);
        for (std::size_t p = 0; p < 3; ++p) {
            before += median(errors(a, 6000, p, truth[p])) / 15.0;
            after += median(errors(b, 6000, p, truth[p])) / 15.0;
        }
    }
    fmt::print("PMSM, noise 0.03 A: mean of medians {:.2e}, through the ratio filter {:.2e}\n", before, after);
    CHECK(after < before);
}
