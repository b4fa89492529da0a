// SPDX-License-Identifier: GPL-3.0-or-later
// Windows that grow from the start, [0, t], as 003 has them: one estimator that says at every t what one with that window says when it first fills.
#include <fmt/format.h>

#include <limits>

#include "tests/plants/changed_model.hpp"
#include "tests/plants/dc_motor.hpp"
#include "tests/plants/dc_motor_model.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

std::vector<std::vector<double>> motor_samples(int count) {
    std::vector<std::vector<double>> out;
    for (const DcMotorSample& s : simulate(DcMotor(), count)) out.push_back({s.y, s.u});
    return out;
}

std::string growing(const std::string& model) {
    return changed(model, {{"[sampling]", "[sampling]\ngrowing = true"}, {"[estimator]", "[estimator]\nengine = \"moments\""}});
}

}  // namespace

TEST_CASE("third-order DC motor on a growing window: the bars of errata.md at 0.8 s and at 3 s, from one estimator") {
    const DcMotor motor;
    const std::vector<double> truth = {motor.a1, motor.a2, motor.b0};
    const plan::Plan plan = plan_of(growing(dc_motor_model(3.0)));
    const auto all = estimates(plan, motor_samples(3501));
    const auto error = [&](std::size_t k) {
        REQUIRE(all[k].status == Status::ok);
        return worst_error(all[k].parameters, truth);
    };
    fmt::print("DC motor, growing window: {:.1e} at 0.8 s, {:.1e} at 1.5 s, {:.1e} at 3 s, {:.1e} at 3.5 s\n", error(800), error(1500), error(3000), error(3500));
    CHECK(error(800) < 1e-4);
    CHECK(error(3000) < 1e-7);
    CHECK(error(3500) < 1e-7);   // it slides now
    CHECK(all[static_cast<std::size_t>(plan.samples_to_first_estimate()) - 2].status == Status::filling);
    CHECK(all[static_cast<std::size_t>(plan.samples_to_first_estimate()) - 1].status != Status::filling);
}

TEST_CASE("a growing window says at t what a window of that length says when it first fills") {
    const auto samples = motor_samples(3001);
    const auto all = estimates(plan_of(growing(dc_motor_model(3.0))), samples);
    for (const int intervals : {700, 1023, 1024, 1025, 2000, 3000}) {
        const auto fixed = estimates(plan_of(dc_motor_model(intervals / 1000.0)), {samples.begin(), samples.begin() + intervals + 1}).back();
        const auto& grown = all[static_cast<std::size_t>(intervals)];
        REQUIRE(fixed.status == Status::ok);
        REQUIRE(grown.status == Status::ok);
        for (std::size_t p = 0; p < 3; ++p) {
            // errata.md: two kinds of weights that are both right to rounding agree to 1e-7 from 0.3 s on
            CHECK(grown.parameters[p] == Approx(fixed.parameters[p]).epsilon(1e-7));
        }
        CHECK(grown.condition == Approx(fixed.condition).epsilon(1e-5));
    }
}

TEST_CASE("a refused sample lets the window grow anew; held inputs, S(t) and single precision too") {
    const std::string coil = growing(changed(committed_model("rl_circuit"), {{"solve = \"square\"", "solve = \"robust\"\nsolve_window = 0.005\naccumulators = \"double\""}}));
    std::vector<std::vector<double>> samples;
    double i = 0.7;
    const double R = 3.01, L = 9e-3, T = 1e-4;
    for (int k = 0; k < 700; ++k) {
        const double v = k / 37 % 2 == 0 ? 5.0 : -2.0;
        samples.push_back({v, i});
        i = v / R + (i - v / R) * std::exp(-R / L * T);   // the voltage stands still until the next sample
    }
    samples[300][0] = std::numeric_limits<double>::quiet_NaN();
    const plan::Plan plan = plan_of(coil);
    const auto fine = estimates(plan, samples);
    const auto coarse = estimates<float>(plan_of(coil, plan::Scalar::float32), samples);
    CHECK(fine[300].status == Status::rejected);
    int coarse_answers = 0;
    for (const std::size_t start : {std::size_t{0}, std::size_t{301}}) {
        const std::size_t first = start + static_cast<std::size_t>(plan.samples_to_first_estimate()) - 1;
        CHECK(first - start < 60);   // 50 instants of S(t) and a few samples, not the 200 of a full window
        CHECK(fine[first - 1].status == Status::filling);
        CHECK(fine[first + 20].status == Status::ok);
        for (std::size_t k = first + 20; k < start + 299; ++k) {
            // the current between samples is an exponential and not a straight line: T R/L squared over 12 is 1e-4
            CHECK(worst_error(fine[k].parameters, {R, L}) < 1e-3);
            if (coarse[k].status != Status::ok) continue;
            ++coarse_answers;
            CHECK(worst_error(coarse[k].parameters, {R, L}) < 5e-3);
        }
    }
    CHECK(coarse_answers > 200);   // of about 450
}

TEST_CASE("what stands against a growing window is said with its place") {
    const auto complaint = [](const std::string& model, plan::Scalar scalar) {
        const test::TemporaryFolder folder;
        Diagnostics diagnostics;
        CHECK_FALSE(generator::plan_from_model(folder.write("model.toml", model), {scalar, ""}, diagnostics));
        std::string out;
        for (const Diagnostic& d : diagnostics.sorted()) out += d.text();
        return out;
    };
    using Catch::Contains;
    const std::string coil = growing(committed_model("rl_circuit"));
    CHECK_THAT(complaint(changed(coil, {{"engine = \"moments\"", "engine = \"fir\""}}), plan::Scalar::float64), Contains("a growing window needs engine moments"));
    CHECK_THAT(complaint(changed(coil, {{"engine = \"moments\"", "engine = \"moments\"\nquadrature = \"trapezoid\""}}), plan::Scalar::float64), Contains("exact quadrature"));
    CHECK_THAT(complaint(coil, plan::Scalar::float32), Contains("accumulators = \"double\""));
}
