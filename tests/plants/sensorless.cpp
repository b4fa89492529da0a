// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 2, 3 and 4 of issue 6: the motor of Delpoux, Bodson, Floquet 2014 without sensors on its shaft, from 88 operating points.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "generator/elimination.hpp"
#include "lab/operating_points.hpp"
#include "tests/plants/sensorless_points.hpp"

using namespace algest;
using namespace algest::plants;
using sensorless_motor::OperatingPoint;
using sensorless_motor::operating_points;

namespace {

const sensorless_motor::Motor motor;

/// Median relative errors of R, L, K over seeds; every seed must be ok.
std::vector<double> median_errors(const plan::Plan& plan, const std::vector<OperatingPoint>& points, unsigned seeds) {
    std::vector<std::vector<double>> all(3);
    for (unsigned seed = 0; seed < seeds; ++seed) {
        const Estimate e = last(plan, noisy(points, seed));
        REQUIRE(e.status == Status::ok);
        const int wanted[] = {R, L, K};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t p = static_cast<std::size_t>(wanted[k]);
            all[k].push_back(relative_error(e.parameters[p], sensorless_truth[p]));
        }
    }
    return {median(all[0]), median(all[1]), median(all[2])};
}

/// The misprint of (34): the cross term with a plus.
const std::pair<std::string, std::string> misprint = {"v_f*i_g - v_g*i_f", "v_f*i_g + v_g*i_f"};

}  // namespace

TEST_CASE("sensorless: exact averages of 88 equilibria give the parameters, both methods, also for a rotated command") {
    for (const double alpha : {0.0, 0.3, -1.1}) {
        const std::vector<OperatingPoint> points = operating_points(motor, alpha);
        REQUIRE(points.size() == 88);
        for (const std::string& method : {first_method, second_method}) {
            INFO(method << ", command at " << alpha);
            const Estimate e = last(plan_of(sensorless_text(method)), points);
            REQUIRE(e.status == Status::ok);
            for (const int p : {R, L, K}) CHECK(sensorless_error(e, p) < 1e-12);
            // Friction is what the first method's resistance leaves of the power: it multiplies an error of R by 150.
            for (const int p : {f_v, C_r}) {
                CHECK(sensorless_error(e, p) < (method == second_method ? 1e-12 : 1.5e-10));
            }
        }
    }
}

TEST_CASE("sensorless: only a rotated command shows the misprinted sign of (34)") {
    const plan::Plan wrong = plan_of(sensorless_text(second_method, {untested, misprint}));
    CHECK(relative_error(last(wrong, operating_points(motor, 0)).parameters[L], motor.L) < 1e-12);
    const Estimate rotated = last(wrong, operating_points(motor, 0.6));
    CHECK(relative_error(rotated.parameters[L], motor.L) > 0.5);
    CHECK(relative_error(rotated.parameters[K], motor.K) > 0.5);
    CHECK(last(plan_of(sensorless_text(second_method, {misprint})), operating_points(motor, 0.6)).status == Status::singular);   // residuals tell
}

TEST_CASE("sensorless: averages with 30 mA of error, medians over 200 seeds, beside the five-parameter least squares") {
    const std::vector<OperatingPoint> points = operating_points(motor, 0);
    const std::vector<double> second = median_errors(plan_of(sensorless_text(second_method)), points, 200);
    CHECK(second[0] < 5e-3);
    CHECK(second[1] < 1.5e-2);
    CHECK(second[2] < 2e-2);
    // Such errors are four times what the first method is content with, and its R 14 percent off: compared are its numbers, which are not ok.
    const std::vector<double> first = median_errors(plan_of(sensorless_text(first_method, {untested})), points, 200);

    // (34) and (35) with R, R^2, L, L^2, K^2 as five unknowns of their own; the friction from the power as before.
    const plan::Plan five = plan_of(sensorless_text(first_method, {untested, {"- R^2*", "- R_2*"}, {"n_p^2*L^2*", "n_p^2*L_2*"}, {"+ K^2*", "+ K_2*"}, {"K = { unit = \"N.m/A\", initial = 0.3, min = 0 }", "K_2 = { unit = \"N^2.m^2/A^2\", initial = 0.09 }\nR_2 = { unit = \"ohm^2\", initial = 9 }\nL_2 = { unit = \"H^2\", initial = 1e-4 }"}}));
    std::vector<std::vector<double>> all(3);
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Estimate e = last(five, noisy(points, seed));
        REQUIRE(e.status == Status::ok);
        all[0].push_back(relative_error(e.parameters[0], motor.R));
        all[1].push_back(relative_error(e.parameters[3], motor.L));
        all[2].push_back(relative_error(e.parameters[4], motor.K * motor.K) / 2);   // of K itself
    }
    const std::vector<double> unconstrained = {median(all[0]), median(all[1]), median(all[2])};
    WARN(fmt::format("median relative errors of R, L, K, 88 points, +-30 mA, 200 seeds: second method {:.1e} {:.1e} {:.1e}; first method {:.1e} {:.1e} {:.1e}; "
                     "five unconstrained parameters {:.1e} {:.1e} {:.1e}",
                     second[0], second[1], second[2], first[0], first[1], first[2], unconstrained[0], unconstrained[1], unconstrained[2]));
    CHECK(unconstrained[0] > first[0]);
    CHECK(unconstrained[0] > 10 * second[0]);
    CHECK(unconstrained[1] > second[1]);
}

TEST_CASE("sensorless: degenerate sets of points give no numbers, with errors and without") {
    const std::vector<OperatingPoint> all = operating_points(motor, 0);
    const std::vector<OperatingPoint> one_speed(all.begin() + 20, all.begin() + 24);
    const std::vector<OperatingPoint> one_point(8, all[20]);
    std::vector<OperatingPoint> two_points = {all[0], all[40]};
    for (const std::string& method : {first_method, second_method}) {
        const plan::Plan plan = plan_of(sensorless_text(method));
        for (const auto& points : {one_speed, one_point, two_points}) {
            INFO(method << ", " << points.size() << " points");
            for (const auto& measured : {points, noisy(points, 1)}) {
                for (const Estimate& e : estimates(plan, samples(measured))) {
                    CHECK((e.status == Status::filling || e.status == Status::singular));
                    CHECK(e.parameters == std::vector<double>{3, 3e-4, 0.05, 0.01, 0.3});   // the initial values
                }
            }
        }
    }
}

TEST_CASE("sensorless: what is missing is named") {
    const plan::Plan plan = plan_of(sensorless_text(second_method));
    const std::vector<OperatingPoint> all = operating_points(motor, 0);
    lab::OperatingPoints points;
    points.quantities = plan.steady->averaged.size();
    CHECK(lab::what_is_missing(plan, points, false)->find("no steady stretch") != std::string::npos);
    for (std::size_t k = 20; k < 24; ++k) points.means.insert(points.means.end(), {all[k].omega, all[k].v_f, all[k].v_g, all[k].i_f, all[k].i_g});
    CHECK(lab::what_is_missing(plan, points, false) == "not identifiable from these data: needs a second value of omega_r, the same at all of 4 operating points");
    CHECK_FALSE(lab::what_is_missing(plan, points, true));
    points.means.clear();   // one current, errors of 30 mA: the power still tells R and friction, the voltages do not tell L from K
    for (const OperatingPoint& p : noisy(at_one_current(all, 2), 1)) points.means.insert(points.means.end(), {p.omega, p.v_f, p.v_g, p.i_f, p.i_g});
    const std::string text = lab::what_is_missing(plan, points, false).value_or("");
    INFO(text);
    CHECK(text.find("22 operating points do not tell L, K apart by more than what their means are uncertain by") != std::string::npos);
}

TEST_CASE("sensorless: a drifting block and an unmarked one are no operating points") {
    const std::vector<OperatingPoint> all = operating_points(motor, 0);
    const plan::Plan plan = plan_of(sensorless_text(second_method));
    lab::HostEstimator<double> estimator(plan);
    OperatingPoint drifting = all[0];
    for (int k = 0; k < 40; ++k, drifting.omega += 0.02) {   // 0.06 rad/s a block, and 0.01 are allowed
        (void)estimator.step(samples({drifting})[0].data());
    }
    CHECK(estimator.points() == 0);

    const plan::Plan marked = plan_of(sensorless_text(second_method, {{"stages =", "stretches = \"point\"\nstages ="}, {"omega_r = {", "point = { unit = \"1\" }\nomega_r = {"}}));
    lab::HostEstimator<double> by_mark(marked);
    const std::vector<std::vector<double>> all_samples = samples(all);
    for (std::size_t k = 0; k < all_samples.size(); ++k) {
        std::vector<double> in = all_samples[k];
        in.insert(in.begin() + 5, k % 8 < 4 ? 0.0 : static_cast<double>(k / 8 + 1));   // every second point is outside of the stretches
        (void)by_mark.step(in.data());
    }
    CHECK(by_mark.points() == 44);
    CHECK(by_mark.status() == Status::ok);
}

TEST_CASE("sensorless: the candidates are told apart as in table A.5") {
    const std::vector<OperatingPoint> points = operating_points(motor, 0);
    for (const std::string& method : {first_method, second_method}) {
        const plan::Plan plan = plan_of(sensorless_text(method));
        lab::HostEstimator<double> estimator(plan);
        for (const std::vector<double>& sample : samples(noisy(points, 3))) (void)estimator.step(sample.data());
        const auto candidates = lab::named_candidates(plan, estimator.candidates());
        REQUIRE_FALSE(candidates.empty());
        std::string table;
        for (const auto& c : candidates) {
            for (const auto& v : c.values) table += fmt::format("{} {:.5g}  ", v.name, v.value);
            table += fmt::format("error {:.4g}  {}\n", c.error, lab::in_words(c.standing));
        }
        INFO(method << "\n" << table);
        CHECK(candidates[0].standing == Standing::best);
        CHECK(relative_error(candidates[0].values.back().value, motor.L) < 0.05);
        for (std::size_t k = 1; k < candidates.size(); ++k) {
            CHECK(candidates[k].standing != Standing::best);
            CHECK((candidates[k].standing == Standing::spurious || candidates[k].error >= candidates[0].error));
        }
    }
}

TEST_CASE("sensorless: the order of elimination of the paper's appendix finds the same, and names what satisfies one equation alone") {
    // Rows of (42) in L, L^2, K^2 with the true resistance; L is eliminated first, K^2 stays: r1 of the appendix.
    std::vector<double> triangle(static_cast<std::size_t>(triangle_scalars(3)), 0.0);
    for (const OperatingPoint& p : noisy(operating_points(motor, 0), 3)) {
        const double I2 = p.i_f * p.i_f + p.i_g * p.i_g, N = motor.n_p, w = p.omega;
        double row[4] = {-2 * N * w * (p.v_f * p.i_g - p.v_g * p.i_f), -N * N * w * w * I2, w * w,
                         p.v_f * p.v_f + p.v_g * p.v_g - 2 * motor.R * (p.v_f * p.i_f + p.v_g * p.i_g) + motor.R * motor.R * I2};
        add_rows(triangle.data(), row, 1, 3, 1.0);
    }
    // dE/dL has degrees 3 and 1 in L and K^2, dE/dK^2 has 2 and 1: the degrees that errata.md gives.
    std::vector<double> terms;
    std::vector<std::uint8_t> factors;
    for (const auto& [exponents, coefficient] : elimination::resultant({true, true, true, true}, {true, true, true})) {
        terms.push_back(cln::double_approx(coefficient));
        for (std::size_t f = 0; f < exponents.size(); ++f) for (int k = 0; k < exponents[f]; ++k) factors.push_back(static_cast<std::uint8_t>(f));
    }
    const EliminationStage stage = {0, 3, 0, 0, 0, 3, 0, 1, 0, 2, 1, 0, static_cast<std::uint16_t>(terms.size()), 0, 5, 3, 3};
    const std::uint16_t column_of[] = {0, 1, 2};
    const double coefficient_of[] = {1, 1, 1};
    const std::uint8_t exponents[] = {1, 0, 2, 0, 0, 1};
    const double sizes[] = {1, 1};
    const Elimination<double> e = {2, {&stage, 1}, {nullptr, 0}, {column_of, 3}, {coefficient_of, 3}, {exponents, 6}, {terms.data(), static_cast<int>(terms.size())}, {factors.data(), static_cast<int>(factors.size())}, {sizes, 2}};
    std::vector<double> scratch(static_cast<std::size_t>(elimination_scratch(e)));
    std::vector<Candidate<double>> found(50);
    CandidateList<double> list = {found.data(), 50, 0};
    double solution[2];
    REQUIRE(eliminate(e, triangle.data(), 3, scratch.data(), solution, {nullptr, 0.0}, &list).regular);
    CHECK(relative_error(solution[0], motor.L) < 0.05);
    CHECK(relative_error(std::sqrt(solution[1]), motor.K) < 0.05);
    int best = 0, spurious = 0;
    for (int k = 0; k < list.count; ++k) {
        INFO(found[static_cast<std::size_t>(k)].x << " " << found[static_cast<std::size_t>(k)].y << " " << found[static_cast<std::size_t>(k)].error);
        best += found[static_cast<std::size_t>(k)].standing == Standing::best ? 1 : 0;
        spurious += found[static_cast<std::size_t>(k)].standing == Standing::spurious ? 1 : 0;
    }
    CHECK(best == 1);
    CHECK(spurious >= 2);   // the cubic in L has three real roots at the right K^2, as in table A.5
}
