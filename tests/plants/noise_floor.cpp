// SPDX-License-Identifier: GPL-3.0-or-later
// A machine that stands still is no machine that is excited: S(t) of declared noise alone is singular, whatever the noise.
#include <fmt/format.h>

#include <random>

#include "generator/blueprint.hpp"
#include "generator/noise_floor.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/pmsm_model.hpp"
#include "tests/plants/rl_circuit.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

/// The committed RL circuit with S(t) and 10 mA of noise declared.
std::string noisy_coil() {
    return changed(committed_model("rl_circuit"), {{"i = { unit = \"A\" }", "i = { unit = \"A\", noise = 0.01 }"}, {"solve = \"square\"", "solve = \"robust\"\nsolve_window = 0.02"}});
}

/// The PMSM at 1 kHz at 20 rad/s and constant currents, seen with noise on the currents.
std::vector<std::vector<double>> standing_pmsm(unsigned seed, int samples) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 0.0173);
    const double i_d = -0.53, i_q = 0.3, omega = 20.0;
    const double v_d = 3.01 * i_d - 50 * 9e-3 * omega * i_q, v_q = 3.01 * i_q + 50 * 9e-3 * omega * i_d + 0.27 * omega;
    std::vector<std::vector<double>> out;
    for (int k = 0; k < samples; ++k) out.push_back({v_d, v_q, i_d + noise(random), i_q + noise(random), omega});
    return out;
}

}  // namespace

TEST_CASE("the noise floor is sixteen times the mean of S(t) over signals that are noise") {
    const plan::Plan plan = plan_of(noisy_coil());
    REQUIRE(plan.noise_floor.size() == 3);
    const auto data = plan::make_blueprint<double>(plan);
    const RowSet<double> rows = data.view().rows;
    REQUIRE(rows.unknowns == 2);
    REQUIRE(rows.signals == 2);
    const std::size_t current = plan.window_signals[0].text == "i" ? 0 : 1;
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(0.0, 0.01);
    const int length = ring_length(rows.samples, 0);
    std::vector<double> rings(static_cast<std::size_t>(ring_scalars(rows.signals, length))), matrix(static_cast<std::size_t>(row_entries(rows.rows, 2))), scratch = matrix;
    constexpr int draws = 4000;
    std::array<double, 3> mean{}, square{};
    for (int draw = 0; draw < draws; ++draw) {
        int head = 0;
        for (int k = 0; k < rows.samples; ++k, head = (head + 1) % length) {
            std::array<double, 2> sample{12.0, 12.0};   // V, which has no noise
            sample[current] = noise(random);
            write_sample(rings.data(), rows.signals, length, head, sample.data());
        }
        evaluate_rows(rows, rings.data(), newest(rows.samples, length, head), matrix.data(), scratch.data());
        std::array<double, 3> sum{};
        for (int r = 0; r < rows.rows; ++r) {
            const double* row = matrix.data() + r * 3;
            sum[1] += row[0] * row[1];
            sum[2] += row[1] * row[1];
        }
        for (std::size_t e = 0; e < 3; ++e) {
            mean[e] += plan.solve_instants * sum[e] / draws;
            square[e] += std::pow(plan.solve_instants * sum[e], 2) / draws;
        }
    }
    CHECK(plan.noise_floor[0] == 0.0);   // the voltage is commanded
    CHECK(plan.noise_floor[1] == 0.0);
    const double error = std::sqrt((square[2] - mean[2] * mean[2]) / draws);
    CHECK(std::abs(plan.noise_floor[2] / 16.0 - mean[2]) < 4.0 * error);   // four standard errors, which are
    CHECK(error < 0.03 * mean[2]);                                         // 2 percent: square root of 2/4000
}

TEST_CASE("PMSM at a constant operating point with noise: no estimate is ok; without the floor all are, and wrong") {
    plan::Plan plan = plan_of(committed_model("pmsm_electrical"));
    std::size_t ok = 0;
    std::vector<double> without_floor;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto samples = standing_pmsm(seed, 1500);
        for (const Estimate& e : estimates(plan, samples)) ok += e.status == Status::ok ? 1 : 0;
        plan::Plan without = plan;
        without.noise_floor.clear();
        for (const Estimate& e : estimates(without, samples)) {
            if (e.status == Status::ok) without_floor.push_back(worst_error(e.parameters, {3.01, 9e-3, 0.27}));
        }
    }
    fmt::print("PMSM at a constant operating point, 20 runs: {} of {} ok; without the floor {}, their median error {:.0f} percent\n", ok, 20 * 1100, without_floor.size(), 100.0 * median(without_floor));
    CHECK(ok == 0);
    CHECK(without_floor.size() == 20 * 1100);
    CHECK(median(without_floor) > 0.5);
}

TEST_CASE("RL circuit: ok while the voltage moves, singular once it rests") {
    const plan::Plan plan = plan_of(noisy_coil());
    std::mt19937_64 random(2);
    std::normal_distribution<double> noise(0.0, 0.01);
    std::vector<std::vector<double>> samples;
    for (const RlSample& s : simulate({}, 6000, [](int k) { return k < 3000 ? 5.0 + 4.0 * std::sin(0.05 * k) : 5.0; })) samples.push_back({s.v, s.i + noise(random)});
    const auto all = estimates(plan, samples);
    for (std::size_t k = static_cast<std::size_t>(plan.samples_to_first_estimate()); k < 3000; ++k) REQUIRE(all[k].status == Status::ok);
    for (std::size_t k = 3500; k < all.size(); ++k) {   // 0.04 s of windows, and L/R = 3 ms
        REQUIRE(all[k].status == Status::singular);
        REQUIRE(all[k].parameters[1] == Approx(9e-3).epsilon(0.1));   // the last good one is held
    }
}

TEST_CASE("the noise floor is for S(t) with declared noise, and survives single precision") {
    CHECK(plan_of(changed(noisy_coil(), {{", noise = 0.01", ""}})).noise_floor.empty());
    CHECK(plan_of(changed(noisy_coil(), {{"solve_window = 0.02", "solve_window = 0.02\nuncertainty = false"}})).noise_floor.empty());
    CHECK(plan_of(changed(noisy_coil(), {{"solve = \"robust\"\nsolve_window = 0.02", "solve = \"square\""}})).noise_floor.empty());
    const plan::Plan plan = plan_of(committed_model("pmsm_electrical"), plan::Scalar::float32);
    for (const Estimate& e : estimates<float>(plan, standing_pmsm(1, 800))) CHECK(e.status != Status::ok);
}
