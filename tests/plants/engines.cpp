// SPDX-License-Identifier: GPL-3.0-or-later
// Engine moments behind whole estimators: what engine fir says, status for status, also after refused samples; and when fir steps in.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/pmsm_model.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

std::string on_moments(const std::string& model) { return changed(model, {{"[estimator]", "[estimator]\nengine = \"moments\""}}); }

/// Smooth signals that excite every model, of the size of an air gap; at `refused` one of them is not a number.
std::vector<std::vector<double>> exciting(std::size_t inputs, int count, int refused) {
    std::vector<std::vector<double>> out;
    for (int k = 0; k < count; ++k) {
        out.emplace_back();
        for (std::size_t i = 0; i < inputs; ++i) {
            const double phase = (0.011 + 0.0073 * static_cast<double>(i)) * k;
            out.back().push_back(2e-3 + 1e-3 * std::sin(phase) + 3e-4 * std::cos(2.9 * phase) + 5e-5 * std::sin(0.37 * k * k + static_cast<double>(i)));
        }
        if (k == refused) out.back()[0] = std::numeric_limits<double>::quiet_NaN();
    }
    return out;
}

/// Largest relative difference of the parameters; the statuses must be the same.
double difference(const std::vector<Estimate>& fir, const std::vector<Estimate>& moments) {
    double out = 0.0;
    int ok = 0;
    for (std::size_t k = 0; k < fir.size(); ++k) {
        REQUIRE(fir[k].status == moments[k].status);
        if (fir[k].status != Status::ok) continue;
        ++ok;
        for (std::size_t p = 0; p < fir[k].parameters.size(); ++p) {
            const double size = std::max(std::abs(fir[k].parameters[p]), 1e-3);   // a perturbation may be zero
            out = std::max(out, std::abs(fir[k].parameters[p] - moments[k].parameters[p]) / size);
        }
    }
    REQUIRE(ok > 100);
    return out;
}

}  // namespace

TEST_CASE("both engines say the same, before and after a refused sample") {
    const std::string bearing = committed_model("magnetic_bearing");
    // Without declared noise, against which fir alone tests S(t).
    const std::string pmsm = changed(committed_model("pmsm_electrical"), {{", noise = 0.0173", ""}, {", noise = 0.0173", ""}});
    const std::vector<std::pair<const char*, std::string>> models = {
        {"dc_motor", changed(committed_model("dc_motor"), {{"window = 3 ", "window = 0.5 "}})},
        {"dc_motor, trapezoid", changed(committed_model("dc_motor"), {{"window = 3 ", "window = 0.5 "}, {"[estimator]", "[estimator]\nquadrature = \"trapezoid\""}})},
        {"magnetic_bearing", bearing},
        {"magnetic_bearing, force", changed(bearing, {{"kappa = 1", "kappa = 1\nperturbation = \"force\""}})},
        {"pendulum", committed_model("pendulum")},
        {"pmsm_electrical", pmsm},
        {"pmsm_electrical, decimated", changed(pmsm, {{"period = 1e-3 ", "period = 5e-4\ndecimate = 2 "}})},
        {"pmsm_electrical, ratio filter", changed(pmsm, {{"[estimator]", "[estimator]\nratio_filter = { omega_n = 15 }"}})},
        {"positioning_axis", committed_model("positioning_axis")},
        {"rl_circuit", committed_model("rl_circuit")},
        {"rl_circuit, offset", changed(committed_model("rl_circuit"), {{"ode = \"L*der(i) = v - R*i\"", "ode = \"L*der(i) = v - R*i\"\nkappa = 1\nperturbation = \"offset\""}})},
    };
    for (const auto& [name, model] : models) {
        INFO(name);
        const plan::Plan plan = plan_of(on_moments(model));
        REQUIRE(plan.moments);
        const int first = plan.samples_to_first_estimate();
        const int refused = first + 201;
        const auto samples = exciting(plan.inputs.size(), refused + 1 + first + 200, refused);
        const auto moments = estimates(plan, samples);
        CHECK(moments[static_cast<std::size_t>(refused)].status == Status::rejected);
        CHECK(moments[static_cast<std::size_t>(refused + first - 1)].status == Status::filling);   // as soon as a new window (and S(t)) is full
        CHECK(moments[static_cast<std::size_t>(refused + first)].status != Status::filling);
        const double found = difference(estimates(plan_of(model), samples), moments);
        fmt::print("engines, {}: parameters differ by {:.1e}\n", name, found);
        // 1e-12 of the largest output, in rows whose outputs nearly cancel for these samples (to 1e-3), under a condition of up to 1e3
        CHECK(found < 1e-6);
    }
}

TEST_CASE("the noisy PMSM on moments is within the bars of errata.md") {
    Pmsm motor;
    motor.current_noise = 0.03;
    const auto all = estimates(plan_of(on_moments(pmsm_model("robust"))), inputs(simulate(motor, 8000)));
    CHECK(worst(errors(all, 4001, 0, motor.R)) < 1.5e-2);
    CHECK(worst(errors(all, 4001, 1, motor.L)) < 1e-2);
    CHECK(worst(errors(all, 4001, 2, motor.K)) < 1e-2);
}

TEST_CASE("the PMSM in single precision over 2000 samples is as right on moments as on tables") {
    const Pmsm motor;
    const auto samples = inputs(simulate(motor, 6000));
    const auto worst_of = [&](const std::string& model) {
        const auto all = estimates<float>(plan_of(model, plan::Scalar::float32), samples);
        return std::max({worst(errors(all, 4100, 0, motor.R)), worst(errors(all, 4100, 1, motor.L)), worst(errors(all, 4100, 2, motor.K))});
    };
    const double fir = worst_of(pmsm_model("robust"));
    const double moments = worst_of(on_moments(pmsm_model("robust")));
    const double in_double = worst_of(changed(on_moments(pmsm_model("robust")), {{"[estimator]", "[estimator]\naccumulators = \"double\""}}));
    fmt::print("float, PMSM, M = 2000, worst: fir {:.1e}, moments {:.1e}, summed in double {:.1e}\n", fir, moments, in_double);
    CHECK(moments < 1e-3);   // the bar of float: PMSM in single_precision.cpp
    CHECK(in_double < 1e-3);
}

TEST_CASE("where moments will not do, fir does, and the notes say why") {
    const std::string pmsm = on_moments(committed_model("pmsm_electrical"));
    const std::vector<std::pair<std::string, std::string>> models = {
        {"Simpson", changed(pmsm, {{"[estimator]", "[estimator]\nquadrature = \"simpson\""}})},
        {"uncertainty()", changed(pmsm, {{"[estimator]", "[estimator]\nuncertainty = true"}})},
        {"deviation_limit", changed(pmsm, {{"[estimator]", "[estimator]\ndeviation_limit = 0.1"}})},
        {"degree 11", changed(on_moments(committed_model("rl_circuit")), {{"v - R*i\"", "v - R*i\"\nkappa = 8\nrows = 2"}})},
    };
    for (const auto& [why, model] : models) {
        INFO(why);
        const plan::Plan plan = plan_of(model);
        CHECK_FALSE(plan.moments);
        CHECK_FALSE(plan.tables[0].weights.empty());
        const auto said = [&reason = why](const std::string& note) { return note.find("fir instead of moments") != std::string::npos && note.find(reason) != std::string::npos; };
        CHECK(std::any_of(plan.notes.begin(), plan.notes.end(), said));
    }
    CHECK(plan_of(pmsm).moments);
    CHECK(plan_of(pmsm).noise.empty());
}
