// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 5 of the first issue, magnetic bearing: force constants in spite of an unknown force, and the timing of the currents.
#include "tests/plants/magnetic_bearing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "generated/magnetic_bearing/magnetic_bearing.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

constexpr int samples_of_06s = 6001;
constexpr std::size_t second_half = 3000;

std::string model(int kappa) {
    return fmt::format(R"(format = 1
name = "bearing"
[sampling]
period = 1e-4
window = 0.02
[signals]
Z = {{ unit = "m" }}
Y = {{ unit = "m" }}
q1 = {{ unit = "A^2" }}
q2 = {{ unit = "A^2" }}
q3 = {{ unit = "A^2" }}
[constants]
mass = {{ value = 6.7, unit = "kg" }}
gap = {{ value = 5e-4, unit = "m" }}
c = {{ value = 0.5, unit = "1" }}
s = {{ value = 0.8660254037844386, unit = "1" }}
[parameters]
lambda1 = {{ unit = "N.m^2/A^2", initial = 4e-6 }}
lambda2 = {{ unit = "N.m^2/A^2", initial = 4e-6 }}
lambda3 = {{ unit = "N.m^2/A^2", initial = 4e-6 }}
[[equation]]
name = "force balance z"
ode = "mass*der(Z,2) = -lambda1*q1/(gap + Z)^2 + lambda2*c*q2/(gap + s*Y - c*Z)^2 + lambda3*c*q3/(gap - s*Y - c*Z)^2"
kappa = {}
rows = 3
[estimator]
solve = "robust"
solve_window = 0.02
)",
                       kappa);
}

/// What is fed for the square of a current that acts from one sample to the next.
enum class Timing {
    centred,  ///< mean of the square over the period around the sample: half of the one before, half of the one after
    after,    ///< over the period that starts at the sample
    before,   ///< over the period that ends there
};

std::vector<std::vector<double>> inputs(const std::vector<BearingSample>& all, Timing timing) {
    std::vector<std::vector<double>> out;
    for (std::size_t k = 1; k < all.size(); ++k) {
        std::vector<double> sample{all[k].Z, all[k].Y};
        for (std::size_t m = 0; m < 3; ++m) {
            const double before = all[k - 1].current[m] * all[k - 1].current[m];
            const double after = all[k].current[m] * all[k].current[m];
            sample.push_back(timing == Timing::centred ? 0.5 * (before + after) : timing == Timing::after ? after : before);
        }
        out.push_back(sample);
    }
    return out;
}

std::vector<Estimate> committed(const std::vector<std::vector<double>>& samples) {
    generated::MagneticBearing estimator;
    std::vector<Estimate> out;
    for (const std::vector<double>& s : samples) {
        const auto e = estimator.step({s[0], s[1], s[2], s[3], s[4]});
        out.push_back({e.status, e.condition, {e.lambda1, e.lambda2, e.lambda3}});
    }
    return out;
}

struct Errors {
    std::vector<double> median, worst;
};

Errors errors_of(const std::vector<Estimate>& all, const MagneticBearing& bearing, const std::string& what) {
    Errors out;
    for (std::size_t p = 0; p < 3; ++p) {
        const auto e = errors(all, second_half, p, bearing.lambda[p]);
        CHECK(e.size() == all.size() - second_half);  // always ok
        out.median.push_back(median(e));
        out.worst.push_back(worst(e));
    }
    fmt::print("bearing, {}: medians {:.1e}, {:.1e}, {:.1e}, worst {:.1e}\n", what, out.median[0], out.median[1],
               out.median[2], worst(out.worst));
    return out;
}

}  // namespace

TEST_CASE("bearing: the closed loop holds the shaft near its ellipse") {
    const MagneticBearing bearing;
    const auto samples = simulate(bearing, samples_of_06s);
    for (std::size_t k = second_half; k < samples.size(); ++k) {
        const double phase = 2.0 * std::numbers::pi * 50.0 * static_cast<double>(k) * bearing.period;
        // a gap of 500 um, force constants believed twice too large: within a third of the ellipse's size
        REQUIRE(std::abs(samples[k].Z - 70e-6 * std::sin(phase)) < 30e-6);
        REQUIRE(std::abs(samples[k].Y - 30e-6 * std::cos(phase)) < 30e-6);
    }
}

TEST_CASE("bearing with a constant force: right with kappa = 1, wrong with kappa = 0") {
    const MagneticBearing bearing;
    const auto samples = inputs(simulate(bearing, samples_of_06s), Timing::centred);
    const Errors one = errors_of(committed(samples), bearing, "8 N, kappa = 1, committed");
    CHECK(worst(one.worst) < 2e-3);  // the bar of errata.md
    const Errors zero = errors_of(estimates(plan_of(model(0)), samples), bearing, "8 N, kappa = 0");
    // errata.md: 9 to 23 percent. Ours are 8.7 to 23.7: the loop's integral is not in errata.md
    CHECK(*std::min_element(zero.median.begin(), zero.median.end()) > 0.08);
    CHECK(worst(zero.median) > 0.2);
    CHECK(worst(zero.median) < 0.26);
}

TEST_CASE("bearing with a slow force: kappa = 1 suffices about, kappa = 2 well") {
    MagneticBearing bearing;
    bearing.slow_force = 4.0;
    const auto samples = inputs(simulate(bearing, samples_of_06s), Timing::centred);
    const Errors one = errors_of(committed(samples), bearing, "8 + 4 sin N, kappa = 1, committed");
    CHECK(worst(one.median) < 1.5e-2);  // the bars of errata.md
    const Errors two = errors_of(estimates(plan_of(model(2)), samples), bearing, "8 + 4 sin N, kappa = 2");
    CHECK(worst(two.worst) < 3e-3);
    CHECK(worst(one.median) > worst(two.median));
}

TEST_CASE("bearing: currents half a sample early or late are wrong by several percent") {
    const MagneticBearing bearing;
    const auto simulated = simulate(bearing, samples_of_06s);
    for (const Timing timing : {Timing::after, Timing::before}) {
        const Errors e = errors_of(committed(inputs(simulated, timing)), bearing,
                                   timing == Timing::after ? "8 N, squares over the period after the sample"
                                                           : "8 N, squares over the period before the sample");
        CHECK(worst(e.median) > 5e-2);  // a sample of 1e-4 s at 50 Hz is 3 percent of a radian; centred squares reach 2e-3
    }
}
