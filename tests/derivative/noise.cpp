// SPDX-License-Identifier: GPL-3.0-or-later
// uncertainty() of derivative rows: noise that goes through the parabola filter, against the change of the estimate by every single sample.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/lab/temporary_file.hpp"

using namespace algest;

namespace {

constexpr const char* model = R"toml(format = 1
name = "reaction"
[sampling]
period = 1e-2
[signals]
x = { unit = "1", noise = 1e-3 }
y = { unit = "1", noise = 2e-3 }
u = { unit = "1/s", noise = 5e-3, hold = "zoh" }
[parameters]
a = { unit = "1/s" }
[[equation]]
ode = "y*der(x) = -a*x*y + u"
[estimator]
functional = "derivative"
solve = "square"
)toml";

std::array<double, 3> sample(int k) {
    const double t = 0.01 * k;
    return {2.0 + std::sin(3.0 * t), 1.5 + std::cos(2.0 * t), 4.0 + std::sin(5.0 * t)};
}

}  // namespace

TEST_CASE("the uncertainty of derivative rows is what changing every sample gives") {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(folder.write("model.toml", model), {}, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(plan);
    CHECK(plan->samples() == 2);   // u is held: the mean of two samples
    constexpr int count = 60;      // longer than the filter remembers
    const auto solved = [&](int changed, std::size_t signal, double by) {
        lab::HostEstimator<double> estimator(*plan);
        for (int k = 0; k < count; ++k) {
            auto s = sample(k);
            if (k == changed) s[signal] += by;
            estimator.step(s.data());
        }
        REQUIRE(estimator.status() == Status::ok);
        return estimator.parameters()[0];
    };
    const std::array<double, 3> sigma{1e-3, 2e-3, 5e-3};
    double variance = 0.0;
    for (std::size_t signal = 0; signal < 3; ++signal) {
        for (int k = 0; k < count; ++k) {
            const double step = 1e-3 * sigma[signal];   // small: what is of second order goes with its square
            variance += std::pow((solved(k, signal, step) - solved(k, signal, -step)) / (2.0 * step) * sigma[signal], 2);
        }
    }
    lab::HostEstimator<double> estimator(*plan);
    for (int k = 0; k < count; ++k) estimator.step(sample(k).data());
    REQUIRE(estimator.uncertainty() == Status::ok);
    CHECK(estimator.deviation()[0] == Approx(std::sqrt(variance)).epsilon(1e-6));   // what the filter remembers beyond 24 samples: below 1e-7
}
