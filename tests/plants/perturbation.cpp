// SPDX-License-Identifier: GPL-3.0-or-later
// The perturbation estimate: a constant force, a ramp, and a voltage in an equation that is divided by its leading coefficient.
#include <fmt/format.h>

#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/magnetic_bearing.hpp"
#include "tests/plants/rl_circuit.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

std::vector<std::vector<double>> bearing_inputs(const std::vector<BearingSample>& all) {
    std::vector<std::vector<double>> out;
    for (std::size_t k = 1; k < all.size(); ++k) {
        out.push_back({all[k].Z, all[k].Y});
        for (std::size_t m = 0; m < 3; ++m) out.back().push_back(0.5 * (all[k - 1].current[m] * all[k - 1].current[m] + all[k].current[m] * all[k].current[m]));
    }
    return out;
}

}  // namespace

TEST_CASE("bearing: the force that nobody measures, constant and slow") {
    MagneticBearing bearing;
    const auto run = [&](const std::string& kappa) {
        const plan::Plan plan = plan_of(changed(committed_model("magnetic_bearing"), {{"kappa = 1", kappa + "\nperturbation = \"force\""}}));
        return estimates(plan, bearing_inputs(simulate(bearing, 6001)));
    };
    const auto constant = run("kappa = 1");
    std::vector<double> error;
    for (std::size_t k = 3000; k < constant.size(); ++k) {
        REQUIRE(constant[k].status == Status::ok);
        REQUIRE(constant[k].parameters.size() == 4);
        error.push_back(std::abs(constant[k].parameters[3] - 8.0));
    }
    fmt::print("bearing, force of 8 N: worst error {:.2g} N\n", worst(error));
    // The force constants are right within 2e-3 (errata.md), and the magnets pull with up to 60 N
    CHECK(worst(error) < 2e-3 * 60.0);

    bearing.slow_force = 4.0;
    const auto slow = run("kappa = 2");
    error.clear();
    for (std::size_t k = 3000; k < slow.size(); ++k) {
        const double start = (static_cast<double>(k) + 1.0) * bearing.period - 0.02;   // the window's oldest sample
        const double middle = slow[k].parameters[3] + 0.01 * slow[k].parameters[4];
        error.push_back(std::abs(middle - bearing.force_z(start + 0.01)));
    }
    fmt::print("bearing, force of 8 + 4 sin N, kappa = 2: worst error in the middle of the window {:.2g} N\n", worst(error));
    CHECK(worst(error) < 3e-3 * 60.0);   // errata.md: kappa = 2 within 3e-3
}

TEST_CASE("RL circuit: an offset of the amplifier, in V although the rows are divided by L") {
    const RlCircuit plant;
    const auto voltage = [](int k) { return 12.0 + static_cast<double>((k / 23 * 7919) % 31) - 12.0; };
    const double offset = 0.7;
    std::vector<std::vector<double>> samples;
    for (const RlSample& s : simulate(plant, 2001, [&](int k) { return voltage(k) + offset; })) samples.push_back({s.v - offset, s.i});
    const plan::Plan plan = plan_of(changed(committed_model("rl_circuit"), {{"[estimator]", "kappa = 1\nperturbation = \"offset\"\n[estimator]"}}));
    REQUIRE(plan.parameters.back().name == "offset");
    CHECK(plan.parameters.back().unit == "V");
    const auto all = estimates(plan, samples);
    std::vector<double> error;
    for (const Estimate& e : all) {
        if (e.status == Status::ok) error.push_back(std::abs(e.parameters[2] - offset));
    }
    REQUIRE(error.size() > 1000);
    fmt::print("RL circuit, offset of 0.7 V: median error {:.1e} V\n", median(error));
    // Straight lines between samples cost (R T/L)^2/12 = 9e-5 of a term of up to 31 V, times what the condition leaves of it
    CHECK(median(error) < 1e-2);
}
