// SPDX-License-Identifier: GPL-3.0-or-later
// Decimation by a boxcar over all signals: what one block is, and the PMSM at 10 kHz with windows at 1 kHz.
#include <fmt/format.h>

#include "algest/boxcar.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/coverage.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("a block is the mean over its periods: of held values exactly, of straight lines exactly") {
    constexpr int decimate = 4;
    const std::array<unsigned char, 2> held{1, 0};
    std::array<double, boxcar_scalars(2)> state{};
    BoxcarProgress progress{};
    std::array<double, 2> mean{};
    const auto value = [](int k) { return static_cast<double>(k * k % 7); };
    int blocks = 0;
    for (int k = 0; k <= 20; ++k) {
        const std::array<double, 2> sample{value(k), value(k)};
        const bool ends = average(state.data(), progress, held.data(), 2, decimate, sample.data(), mean.data());
        CHECK(ends == (k > 0 && k % decimate == 0));
        if (!ends) continue;
        ++blocks;
        double of_held = 0.0, of_lines = 0.0;
        for (int j = k - decimate; j < k; ++j) {
            of_held += value(j) / decimate;
            of_lines += 0.5 * (value(j) + value(j + 1)) / decimate;
        }
        CHECK(mean[0] == of_held);   // small whole numbers over 4: exact
        CHECK(mean[1] == of_lines);
    }
    CHECK(blocks == 5);
}

TEST_CASE("PMSM, decimate = 10: as right as at the full rate, and first ok when both windows are full") {
    Pmsm motor;
    const std::string model = changed(pmsm_model("robust"), {{"period = 1e-4", "period = 1e-4\ndecimate = 10"}});
    const plan::Plan plan = plan_of(model);
    CHECK(plan.samples() == 201);
    CHECK(plan.samples_to_first_estimate() == 4011);   // 401 means, each of ten periods, and the sample that begins the first
    const auto all = estimates(plan, inputs(simulate(motor, 8001)));
    CHECK(all[4009].status == Status::filling);
    CHECK(all[4010].status == Status::ok);
    const std::array<double, 3> truth{motor.R, motor.L, motor.K};
    double error = 0.0;
    for (std::size_t p = 0; p < 3; ++p) error = std::max(error, worst(errors(all, 4010, p, truth[p])));
    fmt::print("PMSM, ideal currents, decimate = 10: worst {:.1e}\n", error);
    CHECK(error < 1e-4);   // the bar of errata.md for the full rate

    const plan::Plan full = plan_of(pmsm_model("robust"));
    motor.current_noise = 0.03;
    std::vector<Reported> noisy{{motor.R, {}, {}, {}}, {motor.L, {}, {}, {}}, {motor.K, {}, {}, {}}};
    double decimated_error = 0.0, full_error = 0.0;
    for (motor.seed = 1; motor.seed <= 15; ++motor.seed) {
        lab::HostEstimator<double> one(plan), other(full);
        const auto samples = simulate(motor, 8001);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            one.push(inputs(samples[k]).data());
            other.push(inputs(samples[k]).data());
            if (k < 5000 || k % 1000 != 0) continue;
            report(one, noisy);
            REQUIRE(other.estimate() == Status::ok);
            for (std::size_t p = 0; p < 3; ++p) {
                decimated_error += std::pow(one.parameters()[p] / truth[p] - 1.0, 2);
                full_error += std::pow(other.parameters()[p] / truth[p] - 1.0, 2);
            }
        }
    }
    print("PMSM, decimate = 10", noisy);
    fmt::print("PMSM, noise 0.03 A: rms error decimated over full rate {:.3f}\n", std::sqrt(decimated_error / full_error));
    CHECK(std::sqrt(decimated_error / full_error) < 1.1);   // nothing is lost: the mean keeps what the kernels, smooth over ten samples, would see
    for (const Reported& r : noisy) {   // 60 intervals, as in uncertainty.cpp
        CHECK(r.coverage() > 0.86);
        CHECK(r.ratio() > 0.73);
        CHECK(r.ratio() < 1.37);
    }
}
