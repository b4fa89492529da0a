// SPDX-License-Identifier: GPL-3.0-or-later
// The ratio filter (000, equation 43): against numerator and denominator through the differential equation, and on the noisy PMSM.
#include <fmt/format.h>

#include "tests/lab/plans.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/coverage.hpp"
#include "tests/plants/rl_circuit.hpp"

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
    int compared = 0, limited = 0, restarts = 0;
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
        REQUIRE(one.status() == Status::ok);
        CHECK(one.parameters()[0] == Approx(input[0] / input[1]).epsilon(1e-12));
        const double share = first ? 1.0 : std::min(1.0, 10.0 * x[1][0] / input[1]);   // no instant counts more than ten filtered ones
        for (double& of_instant : input) of_instant *= share;
        limited += share < 1.0 ? 1 : 0;
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
        if (x[1][0] <= 0.0) {   // an underdamped low-pass swings below 0 where the signal falls silent: singular, and then anew
            REQUIRE(other.status() == Status::singular);
            first = true;
            ++restarts;
            continue;
        }
        REQUIRE(other.status() == Status::ok);
        CHECK(other.parameters()[0] == Approx(x[0][0] / x[1][0]).epsilon(1e-6));   // the ODE library's 1e-9, on a quotient
        ++compared;
    }
    CHECK(compared > 40);
    CHECK(limited > 0);
    CHECK(restarts > 0);
}

namespace {

/// Largest error of R and L, relative, at each sample of an RL circuit whose current is once off by `outlier`; infinity where not ok.
template <class S>
std::vector<double> errors_around(const plan::Plan& plan, int samples, int at, double outlier) {
    const RlCircuit circuit;
    lab::HostEstimator<S> estimator(plan);
    std::vector<double> out;
    for (const RlSample& s : simulate(circuit, samples, [](int k) { return 5.0 + 4.0 * std::sin(0.05 * k) + ((k / 37) % 2 == 0 ? 2.0 : 0.0); })) {
        const bool hit = static_cast<int>(out.size()) == at;
        const Status status = estimator.step(std::array<S, 2>{static_cast<S>(s.v), static_cast<S>(hit ? outlier : s.i)}.data());
        const auto& found = estimator.parameters();
        out.push_back(status == Status::ok ? std::max(std::abs(found[0] / circuit.R - 1.0), std::abs(found[1] / circuit.L - 1.0))
                                           : std::numeric_limits<double>::infinity());
    }
    return out;
}

/// The first sample from which on every error is below `bar`.
std::size_t sound_from(const std::vector<double>& errors, double bar) {
    std::size_t out = errors.size();
    while (out > 0 && errors[out - 1] < bar) --out;
    return out;
}

template <class S>
void heals(plan::Scalar scalar, double bar) {
    const std::string text = changed(committed_model("rl_circuit"), {{"solve = \"square\"", "solve = \"robust\"\nsolve_window = 0.02"}});
    const plan::Plan plain = plan_of(text, scalar);
    const plan::Plan filtered = plan_of(text + "ratio_filter = { omega_n = 15, zeta = 0.707 }\n", scalar);
    const std::size_t gone = 3000 + static_cast<std::size_t>(plain.samples_to_first_estimate());
    for (const double outlier : {30.0, 1e4, 1e7, 1e10, 1e15, 1e19, 1e25, 1e30}) {
        INFO("outlier " << outlier);
        CHECK(sound_from(errors_around<S>(plain, 25000, 3000, outlier), bar) <= gone);
        // Where the determinant leaps the filter starts anew as soon as the outlier has left the windows. Below, its instants count at most
        // ten filtered ones each and fade as exp(-zeta omega_n t): 6e-10 after two seconds, of errors that are below 1e5 here.
        CHECK(sound_from(errors_around<S>(filtered, 25000, 3000, outlier), std::max(bar, 1e-3)) <= gone + (outlier > 1e9 ? 0 : 20000));
    }
}

}  // namespace

// Bars: the current taken as straight between samples is off by (0.05)^2/12 = 2e-4 of its sine; single precision by ten times that.
TEST_CASE("one bad sample leaves the ratio filter, in double") { heals<double>(plan::Scalar::float64, 2e-4); }
TEST_CASE("one bad sample leaves the ratio filter, in float") { heals<float>(plan::Scalar::float32, 1e-2); }

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
