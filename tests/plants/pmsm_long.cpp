// SPDX-License-Identifier: GPL-3.0-or-later
// The PMSM with noisy currents over many seeds.
#include <fmt/format.h>

#include "generator/generate.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/pmsm_model.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("PMSM at 1 kHz, currents with noise of 0.03 A, S(t), 300 seeds") {
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(ALGEST_SOURCE "/models/pmsm_electrical.toml", {}, diagnostics);
    REQUIRE(plan);
    Pmsm motor;
    motor.current_noise = 0.03;
    const std::vector<double> truth{motor.R, motor.L, motor.K};
    std::vector<std::vector<double>> all(3);
    for (motor.seed = 1; motor.seed <= 300; ++motor.seed) {
        const auto fine = simulate(motor, 8010);
        std::vector<std::vector<double>> samples;
        for (std::size_t k = 0; k + 10 <= fine.size(); k += 10) {
            double v_d = 0.0, v_q = 0.0;
            for (std::size_t j = k; j < k + 10; ++j) {
                v_d += fine[j].v_d / 10.0;
                v_q += fine[j].v_q / 10.0;
            }
            samples.push_back({v_d, v_q, fine[k].i_d, fine[k].i_q, fine[k].omega});
        }
        const auto e = estimates(*plan, samples);
        for (std::size_t p = 0; p < 3; ++p) all[p].push_back(median(errors(e, samples.size() / 2, p, truth[p])));
    }
    fmt::print("PMSM, 1 kHz, noise 0.03 A, medians over 300 seeds: R {:.1e}, L {:.1e}, K {:.1e}\n", median(all[0]),
               median(all[1]), median(all[2]));
    // the bars that errata.md states for 10 kHz hold for the committed estimator, too
    CHECK(median(all[0]) < 1.5e-2);
    CHECK(median(all[1]) < 1e-2);
    CHECK(median(all[2]) < 1e-2);
}

TEST_CASE("PMSM at 10 kHz, currents with noise of 0.03 A, S(t), 200 seeds") {
    const plan::Plan plan = plan_of(pmsm_model("robust"));
    Pmsm motor;
    motor.current_noise = 0.03;
    const std::vector<double> truth{motor.R, motor.L, motor.K};
    std::vector<std::vector<double>> all(3);
    for (motor.seed = 1; motor.seed <= 200; ++motor.seed) {
        const auto e = estimates(plan, inputs(simulate(motor, 8001)));
        for (std::size_t p = 0; p < 3; ++p) all[p].push_back(median(errors(e, 4000, p, truth[p])));
    }
    fmt::print(
        "PMSM, 10 kHz, noise 0.03 A, medians over 200 seeds: R {:.1e}, L {:.1e}, K {:.1e}; worst {:.1e}, {:.1e}, {:.1e}\n",
        median(all[0]), median(all[1]), median(all[2]), worst(all[0]), worst(all[1]), worst(all[2]));
    CHECK(median(all[0]) < 1.5e-2);  // the bars of errata.md
    CHECK(median(all[1]) < 1e-2);
    CHECK(median(all[2]) < 1e-2);
}
