// SPDX-License-Identifier: GPL-3.0-or-later
// uncertainty(): against the change of the estimate by every single sample, and over a few seeds; 500 of them are in uncertainty_long.cpp.
#include "tests/plants/coverage.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

std::string coil(const std::string& estimator) {
    return R"toml(format = 1
name = "coil"
[sampling]
period = 1e-3
window = 0.03
[signals]
v = { unit = "V", hold = "zoh" }
i = { unit = "A", noise = 1e-3 }
w = { unit = "rad/s", noise = 0.2 }
[constants]
unit_square = { value = 1, unit = "A^2" }
[parameters]
R = { unit = "ohm", initial = 2 }
L = { unit = "H", initial = 0.02 }
K = { unit = "V.s/rad", initial = 0.05 }
[[equation]]
ode = "L*der(i) = v - R*i - K*w*(1 + i*i/unit_square)"
[estimator]
deviation_limit = 0   # what is tested is the deviation, however large
)toml" + estimator;
}

/// A current and a speed that are smooth, and the voltage that makes them obey the equation at R = 3, L = 0.01, K = 0.1, so that no row has a
/// residual but that of straight lines between samples.
std::array<double, 3> coil_sample(int k) {
    const auto at = [](double t) { return std::array<double, 3>{1.0 + 0.5 * std::sin(90.0 * t), 45.0 * std::cos(90.0 * t), 10.0 + 4.0 * std::sin(170.0 * t)}; };
    const auto voltage = [&](double t) {
        const auto [i, slope, w] = at(t);
        return 0.01 * slope + 3.0 * i + 0.1 * w * (1.0 + i * i);
    };
    const double t = k * 1e-3;
    double mean = 0.0;   // over the period that the sample is held
    for (int j = 0; j < 20; ++j) mean += voltage(t + (j + 0.5) * 5e-5) / 20.0;
    return {mean, at(t)[0], at(t)[2]};
}

/// The deviations by changing each sample of each noisy signal, up and down, and solving anew.
std::vector<double> by_every_sample(const plan::Plan& plan, int count) {
    std::vector<double> variance(plan.parameters.size(), 0.0);
    const auto solved = [&](int changed_sample, std::size_t signal, double by) {
        lab::HostEstimator<double> estimator(plan);
        for (int k = 0; k < count; ++k) {
            auto s = coil_sample(k);
            if (k == changed_sample) s[signal] += by;
            estimator.step(s.data());
        }
        REQUIRE(estimator.status() == Status::ok);
        return estimator.parameters();
    };
    const std::array<double, 3> sigma{0.0, 1e-3, 0.2};
    for (std::size_t signal = 1; signal < 3; ++signal) {
        for (int k = 0; k < count; ++k) {
            const double step = 1e-3 * sigma[signal];   // small: what is of second order goes with its square
            const auto up = solved(k, signal, step);
            const auto down = solved(k, signal, -step);
            for (std::size_t p = 0; p < variance.size(); ++p) variance[p] += std::pow((up[p] - down[p]) / (2.0 * step) * sigma[signal], 2);
        }
    }
    for (double& v : variance) v = std::sqrt(v);
    return variance;
}

}  // namespace

TEST_CASE("uncertainty() is what changing every sample gives: square, overdetermined, whitened, S(t)") {
    struct Case {
        std::string estimator;
        int count;
        double tolerance;
    };
    // Square: exact but for the second order of the steps. Else the rows keep the residual of straight lines between samples, about
    // (90 T)^2/12 = 7e-4 of a term, times the condition; whitening moves with the estimate, too. S(t) over 61 instants takes every other one.
    for (const Case& c : {Case{"", 31, 1e-5}, Case{"form = 2\n", 31, 1e-5}, Case{"solve = \"robust\"\nsolve_window = 0.02\n", 60, 2e-2},
                          Case{"solve = \"robust\"\nsolve_window = 0.06\n", 100, 3e-2}}) {
        INFO(c.estimator);
        const plan::Plan plan = plan_of(coil(c.estimator));
        REQUIRE(plan.partials.size() == 2);   // of i^2 w, by i and by w
        lab::HostEstimator<double> estimator(plan);
        for (int k = 0; k < c.count; ++k) estimator.step(coil_sample(k).data());
        REQUIRE(estimator.status() == Status::ok);
        REQUIRE(estimator.uncertainty() == Status::ok);
        const auto wanted = by_every_sample(plan, c.count);
        for (std::size_t p = 0; p < wanted.size(); ++p) CHECK(estimator.deviation()[p] == Approx(wanted[p]).epsilon(c.tolerance));
    }
    for (const char* rows : {"rows = 5\n[estimator]\n", "rows = 5\n[estimator]\nwhiten = true\n"}) {
        INFO(rows);
        const std::string text = changed(coil(""), {{"[estimator]\n", rows}});
        const plan::Plan plan = plan_of(text);
        lab::HostEstimator<double> estimator(plan);
        for (int k = 0; k < 31; ++k) estimator.step(coil_sample(k).data());
        REQUIRE(estimator.uncertainty() == Status::ok);
        const auto wanted = by_every_sample(plan, 31);
        for (std::size_t p = 0; p < wanted.size(); ++p) CHECK(estimator.deviation()[p] == Approx(wanted[p]).epsilon(3e-2));
    }
}

TEST_CASE("uncertainty() of signals that are one sample late is what changing every sample gives") {
    const plan::Plan plan = plan_of(R"(format = 1
name = "axis"
[sampling]
period = 1e-3
window = 0.05
[signals]
q = { unit = "m", noise = 1e-5 }
force = { unit = "N", hold = "zoh", noise = 0.5 }
[parameters]
M = { unit = "kg", initial = 90 }
Fv = { unit = "N.s/m", initial = 200 }
Fc = { unit = "N", initial = 20 }
[[equation]]
ode = "M*der(q,2) + Fv*der(q) + Fc*sgn(der(q)) = force"
[estimator]
deviation_limit = 0
)");
    for (const plan::NoiseChannel& c : plan.noise) CHECK(c.lag == 1);
    constexpr int count = 52;   // the window, and the sample before it
    const auto solved = [&](int changed_sample, std::size_t signal, double by) {
        lab::HostEstimator<double> estimator(plan);
        for (int k = 0; k < count; ++k) {
            const double t = k * 1e-3;   // turns at 0.026 s, so that friction and damping part
            std::array<double, 2> s{0.02 * std::sin(60.0 * t), -95.0 * 72.0 * std::sin(60.0 * t) + 240.0 * std::cos(60.0 * t) + (t < 0.026 ? 20.0 : -20.0) + 30.0 * std::sin(200.0 * t)};
            if (k == changed_sample) s[signal] += by;
            estimator.push(s.data());
        }
        REQUIRE(estimator.estimate() == Status::ok);
        return estimator;
    };
    std::array<double, 3> variance{};
    const std::array<double, 2> sigma{1e-5, 0.5};
    for (std::size_t signal = 0; signal < 2; ++signal) {
        for (int k = 0; k < count; ++k) {
            const double step = 1e-3 * sigma[signal];
            const auto up = solved(k, signal, step), down = solved(k, signal, -step);
            for (std::size_t p = 0; p < 3; ++p) variance[p] += std::pow((up.parameters()[p] - down.parameters()[p]) / (2.0 * step) * sigma[signal], 2);
        }
    }
    auto estimator = solved(-1, 0, 0.0);
    REQUIRE(estimator.uncertainty() == Status::ok);
    for (std::size_t p = 0; p < 3; ++p) CHECK(estimator.deviation()[p] == Approx(std::sqrt(variance[p])).epsilon(1e-4));   // square: exact but for the steps
}

TEST_CASE("uncertainty() of a delayed signal is what changing every sample gives, those before the window included") {
    // A square solve has no residual at its own estimate, whatever the samples: exact but for the second order of the steps.
    for (const char* delay : {"delay(w, 0.004)", "delay(w, 0.0043)", "(w + delay(w, 0.002))"}) {
        INFO(delay);
        const plan::Plan plan = plan_of(changed(coil(""), {{"K*w*", std::string("K*") + delay + "*"}}));
        const int count = plan.samples_to_first_estimate();
        CHECK(count == 31 + plan.delay_length());
        lab::HostEstimator<double> estimator(plan);
        for (int k = 0; k < count; ++k) estimator.step(coil_sample(k).data());
        REQUIRE(estimator.status() == Status::ok);
        REQUIRE(estimator.uncertainty() == Status::ok);
        const auto wanted = by_every_sample(plan, count);
        for (std::size_t p = 0; p < wanted.size(); ++p) CHECK(estimator.deviation()[p] == Approx(wanted[p]).epsilon(1e-4));
    }
}

TEST_CASE("the bias that noisy regressors cause is the mean error over many seeds") {
    for (const char* solve : {"", "solve = \"robust\"\nsolve_window = 0.02\n"}) {
        const plan::Plan plan = plan_of(changed(coil(solve), {{"noise = 1e-3", "noise = 6e-3"}, {"noise = 0.2", "noise = 0.4"}}));
        const auto run = [&](double size, unsigned seed) {
            std::mt19937_64 random(seed);
            std::normal_distribution<double> noise;
            lab::HostEstimator<double> estimator(plan);
            for (int k = 0; k < 60; ++k) {
                auto s = coil_sample(k);
                s[1] += size * 6e-3 * noise(random);
                s[2] += size * 0.4 * noise(random);
                estimator.step(s.data());
            }
            REQUIRE(estimator.uncertainty() == Status::ok);
            return estimator;
        };
        constexpr unsigned pairs = 3000;
        const auto still = run(0.0, 1);   // what straight lines leave is no bias of noise
        std::vector<double> mean(3, 0.0), square(3, 0.0);
        for (unsigned seed = 1; seed <= pairs; ++seed) {
            const auto up = run(1.0, seed), down = run(-1.0, seed);   // antithetic: what is linear in the noise cancels
            for (std::size_t p = 0; p < 3; ++p) {
                const double error = 0.5 * (up.parameters()[p] + down.parameters()[p]) - still.parameters()[p];
                mean[p] += error / pairs;
                square[p] += error * error / pairs;
            }
        }
        for (std::size_t p = 0; p < 3; ++p) {
            const double standard_error = std::sqrt((square[p] - mean[p] * mean[p]) / pairs);
            fmt::print("coil, {}: bias of {} reported {:.2e}, found {:.2e} +- {:.1e}\n", plan.solve == Solve::square ? "square" : "S(t)", plan.parameters[p].name, still.bias()[p],
                       mean[p], standard_error);
            // four standard errors, and a tenth for the fourth order of the noise
            CHECK(std::abs(still.bias()[p] - mean[p]) < 4.0 * standard_error + 0.1 * std::abs(mean[p]));
            if (p != 1) CHECK(std::abs(mean[p]) > 4.0 * standard_error);   // there is a bias to be found; that of L is small
        }
    }
}

TEST_CASE("95 percent intervals and standard deviations over a few seeds: dc_motor, bearing, PMSM") {
    const auto check = [](const char* what, const std::vector<Reported>& all) {
        print(what, all);
        for (const Reported& r : all) {
            REQUIRE(r.size() >= 60.0);
            // 60 intervals: 95 percent +- three binomial deviations of 2.8, a standard deviation +- three of 1/sqrt(120) = 9 percent
            CHECK(r.coverage() > 0.86);
            CHECK(r.ratio() > 0.73);
            CHECK(r.ratio() < 1.37);
        }
    };
    check("dc_motor, 2 s", dc_motor_reports(60));
    check("bearing", bearing_reports(60));
    check("PMSM", pmsm_reports(15));
}
