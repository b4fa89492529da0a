// SPDX-License-Identifier: GPL-3.0-or-later
// Partial derivatives of window signals and of the parameter map, against differences, for every function of formulas.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tests/plants/estimates.hpp"

using namespace algest;

namespace {

const std::string text = R"toml(format = 1
name = "functions"
[sampling]
period = 1e-3
window = 0.04
[signals]
a = { unit = "1", noise = 1 }
b = { unit = "1", noise = 1 }
c = { unit = "1", noise = 1 }
[constants]
half = { value = "1/2", unit = "1" }
third = { value = "1/3", unit = "1" }
[parameters]
p1 = { unit = "s", initial = 1 }
p2 = { unit = "1", initial = -2 }
p3 = { unit = "1", initial = "1/3" }
[[equation]]
ode = "p1*der(a) + p2*sin(a*third + b)*cos(b)/(1 + c*c) + p3*min(abs(b - a), c)^2*max(a, b) = exp(-a*a)*tan(half*c) + log(1 + b*b)/sqrt(2 + c*c) + a^third*sgn(b) + a^b + a^3*b"
[estimator]
solve = "robust"
)toml";

}  // namespace

TEST_CASE("partial derivatives of every function are those of differences") {
    const plan::Plan plan = plants::plan_of(text);
    REQUIRE(plan.partials.size() > 5);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> positive(0.3, 1.7);
    std::vector<double> values(plan.signals.operations.size());
    const auto evaluated = [&](const std::vector<double>& in) {
        std::vector<double> out(plan.signals.results.size());
        plan::evaluate<double>(plan.signals, in.data(), nullptr, nullptr, values.data(), out.data());
        return out;
    };
    for (int round = 0; round < 50; ++round) {
        const std::vector<double> at{positive(random), positive(random), positive(random)};
        const auto here = evaluated(at);
        for (std::size_t w = 0; w < plan.window_signals.size(); ++w) {
            for (int i = 0; i < 3; ++i) {
                const double step = 1e-6;
                auto up = at, down = at;
                up[static_cast<std::size_t>(i)] += step;
                down[static_cast<std::size_t>(i)] -= step;
                const double slope = (evaluated(up)[w] - evaluated(down)[w]) / (2.0 * step);
                double found = 0.0;
                for (const plan::NoiseChannel& c : plan.noise) {   // noise = 1: the factor is the derivative, or 1
                    if (c.input != i || c.signal != static_cast<int>(w)) continue;
                    found += c.factor * (c.partial < 0 ? 1.0 : here[plan.window_signals.size() + static_cast<std::size_t>(c.partial)]);
                }
                INFO(plan.window_signals[w].text << " by " << plan.inputs[static_cast<std::size_t>(i)].name);
                CHECK(found == Approx(slope).epsilon(1e-6).margin(1e-7));   // of differences: third derivatives times 1e-12, rounding 1e-10
            }
        }
    }
}

TEST_CASE("gradient and second derivatives of the parameter map are those of differences") {
    const plan::Plan plan = plants::plan_of(text);
    const std::size_t n = plan.lumped.size(), parameters = plan.parameters.size();
    REQUIRE(plan.map_derivatives.results.size() == parameters * (n + n * (n + 1) / 2));
    std::vector<double> values(std::max(plan.parameter_map.operations.size(), plan.map_derivatives.operations.size()));
    const auto evaluated = [&](const plan::Tape& tape, const std::vector<double>& in) {
        std::vector<double> out(tape.results.size());
        plan::evaluate<double>(tape, in.data(), nullptr, nullptr, values.data(), out.data());
        return out;
    };
    std::vector<double> at;
    for (std::size_t u = 0; u < n; ++u) at.push_back(0.7 + 0.4 * static_cast<double>(u));
    const auto derivatives = evaluated(plan.map_derivatives, at);
    const double step = 1e-4;
    for (std::size_t p = 0; p < parameters; ++p) {
        std::size_t entry = parameters * n + p * n * (n + 1) / 2;
        for (std::size_t u = 0; u < n; ++u) {
            const auto moved = [&](double by_u, std::size_t v, double by_v) {
                auto in = at;
                in[u] += by_u;
                in[v] += by_v;
                return evaluated(plan.parameter_map, in)[p];
            };
            CHECK(derivatives[p * n + u] == Approx((moved(step, u, 0) - moved(-step, u, 0)) / (2 * step)).epsilon(1e-6).margin(1e-7));
            for (std::size_t v = u; v < n; ++v, ++entry) {
                const double second = (moved(step, v, step) - moved(step, v, -step) - moved(-step, v, step) + moved(-step, v, -step)) / (4 * step * step);
                CHECK(derivatives[entry] == Approx(second).epsilon(1e-5).margin(1e-6));   // rounding: 1e-16 over the square of the step
            }
        }
    }
}
