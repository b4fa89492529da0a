// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 5 of the first issue, PMSM: R, L and K in closed loop, ideal and noisy currents, with equations (26) and (27) of 000
// as errata.md corrects them.
#include "tests/plants/pmsm.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <numbers>

#include "generated/pmsm_electrical/pmsm_electrical.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/functional.hpp"
#include "tests/plants/pmsm_model.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

constexpr int samples_of_08s = 8001;
constexpr std::size_t second_half = 4000;

/// Medians of R, L, K over the second half.
std::array<double, 3> medians(const std::vector<Estimate>& all, const Pmsm& motor) {
    return {median(errors(all, second_half, 0, motor.R)), median(errors(all, second_half, 1, motor.L)),
            median(errors(all, second_half, 2, motor.K))};
}

void print(const std::string& what, const std::array<double, 3>& e) {
    fmt::print("PMSM, {}: R {:.1e}, L {:.1e}, K {:.1e}\n", what, e[0], e[1], e[2]);
}

}  // namespace

TEST_CASE("PMSM, the closed loop of errata.md") {
    Pmsm motor;
    const auto samples = simulate(motor, samples_of_08s);
    double speed_error = 0.0, direct = 0.0;
    for (std::size_t k = second_half; k < samples.size(); ++k) {
        const double wanted = 20.0 + 5.0 * std::sin(2.0 * std::numbers::pi * 5.0 * static_cast<double>(k) * motor.period);
        speed_error += std::pow(samples[k].omega - wanted, 2);
        direct += samples[k].i_d;
    }
    const double n = static_cast<double>(samples.size() - second_half);
    // errata.md: 0.028 rad/s rms with the paper's estimates (ours are the true constants); a direct current of about -0.53 A
    CHECK(std::sqrt(speed_error / n) < 0.03);
    CHECK(direct / n == Approx(-0.53).margin(0.03));
}

TEST_CASE("PMSM, ideal currents: S(t) and square solve, timing of the voltage") {
    const Pmsm motor;
    const auto samples = inputs(simulate(motor, samples_of_08s));
    const auto robust = estimates(plan_of(pmsm_model("robust")), samples);
    print("S(t), zoh, median", medians(robust, motor));
    const std::array<double, 3> truth{motor.R, motor.L, motor.K};
    for (std::size_t p = 0; p < 3; ++p) {
        const auto e = errors(robust, second_half, p, truth[p]);
        CHECK(e.size() == samples.size() - second_half);  // always ok
        CHECK(worst(e) < 1e-4);
    }

    // (22): 500 periods of the speed make the square solve singular now and then, hence medians
    const auto square = medians(estimates(plan_of(pmsm_model("square")), samples), motor);
    print("square, zoh, median", square);
    CHECK(worst({square.begin(), square.end()}) < 1e-4);

    const auto half_a_sample = medians(estimates(plan_of(pmsm_model("square", "linear")), samples), motor);
    print("square, linear, median", half_a_sample);
    CHECK(worst({half_a_sample.begin(), half_a_sample.end()}) < 5e-3);
    // errata.md: 1.6e-3 to 2.7e-3 instead of 2e-5
    CHECK(*std::min_element(half_a_sample.begin(), half_a_sample.end()) > 1e-3);
}

TEST_CASE("PMSM, tables in reversed order are seen") {
    const Pmsm motor;
    const auto samples = inputs(simulate(motor, samples_of_08s));
    plan::Plan plan = plan_of(pmsm_model("square"));
    for (plan::Table& table : plan.tables) std::reverse(table.weights.begin(), table.weights.end());
    const auto e = medians(estimates(plan, samples), motor);
    print("square, tables reversed, median", e);
    CHECK(worst({e.begin(), e.end()}) > 5e-3);  // errata.md: 1 to 1.5 percent; the bar that holds otherwise is 1e-4
}

TEST_CASE("PMSM, currents with noise of 0.03 A, S(t)") {
    Pmsm motor;
    motor.current_noise = 0.03;
    const plan::Plan plan = plan_of(pmsm_model("robust"));
    std::array<std::vector<double>, 3> all;
    for (motor.seed = 1; motor.seed <= 5; ++motor.seed) {
        const auto e = medians(estimates(plan, inputs(simulate(motor, samples_of_08s))), motor);
        for (std::size_t p = 0; p < 3; ++p) all[p].push_back(e[p]);
    }
    print("S(t), noise 0.03 A, median of 5 seeds", {median(all[0]), median(all[1]), median(all[2])});
    print("S(t), noise 0.03 A, worst of 5 seeds", {worst(all[0]), worst(all[1]), worst(all[2])});
    // the bars of errata.md, for the median; every one of these seeds keeps them
    CHECK(worst(all[0]) < 1.5e-2);
    CHECK(worst(all[1]) < 1e-2);
    CHECK(worst(all[2]) < 1e-2);
    CHECK(median(all[0]) > 1e-4);  // the noise is there
}

TEST_CASE("PMSM without direct current: the square solve loses R in noise") {
    Pmsm motor;
    motor.current_noise = 0.03;
    const plan::Plan plan = plan_of(pmsm_model("square"));
    const auto with = medians(estimates(plan, inputs(simulate(motor, samples_of_08s))), motor);
    motor.direct_current = false;
    const auto without = medians(estimates(plan, inputs(simulate(motor, samples_of_08s))), motor);
    print("square, noise 0.03 A, median", with);
    print("square, noise 0.03 A, i_d* = 0, median", without);
    CHECK(with[0] < 1.5e-2);
    CHECK(without[0] > 0.5);  // errata.md: identifiability needs a direct current
}

TEST_CASE("PMSM, equations (26) and (27): as corrected they are the estimator, as printed K is wrong") {
    const Pmsm motor;
    const auto samples = simulate(motor, samples_of_08s);
    const auto plan = plan_of(pmsm_model("square"));
    const auto all = estimates(plan, inputs(samples));
    std::vector<double> misprint_26, misprint_27;
    for (std::size_t end = second_half; end < samples.size(); end += 379) {
        std::vector<double> v_d, v_q, i_d, i_q, omega, omega_d, omega_q;
        for (std::size_t k = end - 2000; k <= end; ++k) {
            const PmsmSample& s = samples[k];
            v_d.push_back(s.v_d);
            v_q.push_back(s.v_q);
            i_d.push_back(s.i_d);
            i_q.push_back(s.i_q);
            omega.push_back(s.omega);
            omega_d.push_back(motor.n_p * s.omega * s.i_d);
            omega_q.push_back(motor.n_p * s.omega * s.i_q);
        }
        const auto F = [&](int i, int p, const std::vector<double>& f) {
            const Between between = &f == &v_d || &f == &v_q ? Between::held : Between::linear;
            return functional(1, 0, i, p, f, 1e-4L, between);
        };
        using Matrix = Eigen::Matrix<long double, 3, 3>;
        using Vector = Eigen::Matrix<long double, 3, 1>;
        Matrix P;
        P << -F(0, 1, v_d), F(0, 1, i_d), 0.0L,  //
            -F(0, 2, v_d), F(0, 2, i_d), 0.0L,   //
            -F(0, 1, v_q), F(0, 1, i_q), F(0, 1, omega);
        Vector Q;
        Q << -F(1, 1, i_d) + F(0, 1, omega_q), -F(1, 2, i_d) + F(0, 2, omega_q), -F(1, 1, i_q) - F(0, 1, omega_d);
        const Vector gamma = P.fullPivLu().solve(Q);

        REQUIRE(all[end].status == Status::ok);
        const std::vector<double>& found = all[end].parameters;
        // rounding of double alone: the condition here is about 100, a functional carries about 1e-14
        const double tolerance = 1e-13 * all[end].condition;
        CHECK(relative_error(found[0], static_cast<double>(gamma(1) / gamma(0))) < tolerance);
        CHECK(relative_error(found[1], static_cast<double>(1.0L / gamma(0))) < tolerance);
        CHECK(relative_error(found[2], static_cast<double>(gamma(2) / gamma(0))) < tolerance);

        Matrix printed_P = P;  // with time normalised as in section III: F_{0,3} has two more powers of the window's 0.2 s
        printed_P(2, 2) = F(0, 3, omega) / (0.2L * 0.2L);
        const Vector with_26 = printed_P.fullPivLu().solve(Q);
        misprint_26.push_back(static_cast<double>(with_26(2) / with_26(0)) / motor.K - 1.0);
        Vector printed_Q = Q;
        printed_Q(2) = -F(1, 1, i_q) + F(1, 1, omega_d);
        const Vector with_27 = P.fullPivLu().solve(printed_Q);
        misprint_27.push_back(static_cast<double>(with_27(2) / with_27(0)) / motor.K - 1.0);
    }
    fmt::print("PMSM, K as (26) is printed: {:+.0f} percent, as (27) is printed: {:+.0f} percent (medians)\n",
               100.0 * median(misprint_26), 100.0 * median(misprint_27));
    // errata.md: +1900 and -90 percent; the excitation of another controller moves these by some
    CHECK(median(misprint_26) == Approx(19.0).epsilon(0.1));
    CHECK(median(misprint_27) == Approx(-0.9).epsilon(0.1));
}

TEST_CASE("PMSM, the committed estimator at 1 kHz: control ten times faster, and control at 1 kHz") {
    const auto run = [](const Pmsm& motor, const std::vector<PmsmSample>& samples) {
        generated::PmsmElectrical estimator;
        std::vector<Estimate> out;
        for (const PmsmSample& s : samples) {
            const auto e = estimator.step({s.v_d, s.v_q, s.i_d, s.i_q, s.omega});
            out.push_back({e.status, e.condition, {e.R, e.L, e.K}});
        }
        REQUIRE(out.size() > 800);
        const std::size_t begin = out.size() / 2;
        const std::array<double, 3> truth{motor.R, motor.L, motor.K};
        std::array<double, 3> worst_of{};
        for (std::size_t p = 0; p < 3; ++p) worst_of[p] = worst(errors(out, begin, p, truth[p]));
        return worst_of;
    };
    Pmsm motor;
    const auto fine = simulate(motor, 10 * 1001);
    // Every tenth sample, with the mean of the ten voltages that act until the next.
    const auto thinned = [&](const std::vector<PmsmSample>& all, std::size_t first, std::size_t count) {
        std::vector<PmsmSample> out;
        for (std::size_t k = 0; k + 10 <= all.size(); k += 10) {
            PmsmSample s = all[k];
            s.v_d = s.v_q = 0.0;
            for (std::size_t j = first; j < first + count; ++j) {
                s.v_d += all[k + j].v_d / static_cast<double>(count);
                s.v_q += all[k + j].v_q / static_cast<double>(count);
            }
            out.push_back(s);
        }
        return out;
    };
    const auto averaged = run(motor, thinned(fine, 0, 10));
    print("committed, 1 kHz, mean of ten held voltages, worst", averaged);
    CHECK(worst({averaged.begin(), averaged.end()}) < 1e-4);
    const auto sampled = run(motor, thinned(fine, 0, 1));
    print("committed, 1 kHz, one voltage of ten, worst", sampled);
    CHECK(worst({sampled.begin(), sampled.end()}) < 5e-3);  // as if half a sample late

    motor.period = 1e-3;
    const auto coarse = run(motor, simulate(motor, 1001));
    print("committed, control and estimator at 1 kHz, worst", coarse);
    // omega i_q goes straight between samples of 1 ms only about: (2 pi 5 T)^2 / 12 = 8e-5 of each of its parts, and more where
    // the current loop rings
    CHECK(worst({coarse.begin(), coarse.end()}) < 5e-4);
}
