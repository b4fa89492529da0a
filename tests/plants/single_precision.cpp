// SPDX-License-Identifier: GPL-3.0-or-later
// The estimators in float: good enough for the PMSM and the bearing, the third-order DC motor on a short
// window loses most of its digits.
#include <fmt/format.h>

#include "tests/plants/dc_motor.hpp"
#include "tests/plants/dc_motor_model.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/magnetic_bearing.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/pmsm_model.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

plan::Plan in_float(const std::string& model) {
    Diagnostics diagnostics;
    const auto plan =
        generator::plan_from_model(ALGEST_SOURCE "/models/" + model + ".toml", {plan::Scalar::float32, ""}, diagnostics);
    REQUIRE(plan);
    return *plan;
}

double worst_of(const std::vector<Estimate>& all, const std::vector<double>& truth) {
    double out = 0.0;
    for (std::size_t p = 0; p < truth.size(); ++p) out = std::max(out, worst(errors(all, all.size() / 2, p, truth[p])));
    return out;
}

}  // namespace

TEST_CASE("float: PMSM") {
    Pmsm motor;
    motor.period = 1e-3;
    std::vector<std::vector<double>> samples;
    for (const PmsmSample& s : simulate(motor, 1001)) samples.push_back({s.v_d, s.v_q, s.i_d, s.i_q, s.omega});
    const double error = worst_of(estimates<float>(in_float("pmsm_electrical"), samples), {motor.R, motor.L, motor.K});
    fmt::print("float, PMSM, ideal currents, worst: {:.1e}\n", error);
    CHECK(error < 1e-3);  // a tenth of what the sensors' noise leaves
}

TEST_CASE("float: what uncertainty() says of the PMSM is what it says in double") {
    Pmsm motor;
    motor.period = 1e-3;
    motor.current_noise = 0.03;
    Diagnostics diagnostics;
    const auto in_double = generator::plan_from_model(ALGEST_SOURCE "/models/pmsm_electrical.toml", {}, diagnostics);
    const plan::Plan plan = in_float("pmsm_electrical");
    REQUIRE(in_double);
    lab::HostEstimator<double> fine(*in_double);
    lab::HostEstimator<float> coarse(plan);
    for (const PmsmSample& s : simulate(motor, 1001)) {
        fine.push(inputs(s).data());
        coarse.push(std::array<float, 5>{static_cast<float>(s.v_d), static_cast<float>(s.v_q), static_cast<float>(s.i_d), static_cast<float>(s.i_q), static_cast<float>(s.omega)}.data());
    }
    REQUIRE(fine.uncertainty() == Status::ok);
    REQUIRE(coarse.uncertainty() == Status::ok);
    for (std::size_t p = 0; p < 3; ++p) {
        fmt::print("float, PMSM, sd of {}: {:.4e}, in double {:.4e}\n", plan.parameters[p].name, coarse.deviation()[p], fine.deviation()[p]);
        CHECK(coarse.deviation()[p] == Approx(fine.deviation()[p]).epsilon(1e-2));   // S(t) squares a condition of about 30: 1e3 times 6e-8, and a decade
    }
}

TEST_CASE("float: bearing, in SI units") {
    const MagneticBearing bearing;
    const auto all = simulate(bearing, 4001);
    std::vector<std::vector<double>> samples;
    for (std::size_t k = 1; k < all.size(); ++k) {
        samples.push_back({all[k].Z, all[k].Y});
        for (std::size_t m = 0; m < 3; ++m) {
            const double before = all[k - 1].current[m], after = all[k].current[m];
            samples.back().push_back(0.5 * (before * before + after * after));
        }
    }
    const double error =
        worst_of(estimates<float>(in_float("magnetic_bearing"), samples), {bearing.lambda.begin(), bearing.lambda.end()});
    fmt::print("float, bearing, 8 N, kappa = 1, worst: {:.1e}\n", error);
    CHECK(error < 2e-3);  // the bar of errata.md for double
}

TEST_CASE("float: third-order DC motor") {
    const DcMotor plant;
    std::vector<std::vector<double>> samples;
    for (const DcMotorSample& s : simulate(plant, 3001)) samples.push_back({s.y, s.u});
    for (const double window : {0.8, 1.5, 3.0}) {
        const auto plan = plan_of(dc_motor_model(window), plan::Scalar::float32);
        const auto all = estimates<float>(plan, samples);
        std::vector<double> found;
        for (const Estimate& e : all) {
            if (e.status == Status::ok) found.push_back(worst_error(e.parameters, {plant.a1, plant.a2, plant.b0}));
        }
        REQUIRE_FALSE(found.empty());
        fmt::print("float, DC motor, window {} s: at first fill {:.1e}, worst {:.1e}\n", window, found.front(),
                   worst(found));
        // errata.md: 5e-2, where double reaches 1e-8. Eight lanes in the dot product and weights rounded once leave a tenth of it
        if (window == 0.8) {
            CHECK(worst(found) < 5e-2);
            CHECK(worst(found) > 1e-4);
        }
    }
}
