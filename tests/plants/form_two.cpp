// SPDX-License-Identifier: GPL-3.0-or-later
// The two forms of the annihilator give the same square estimates (003; errata.md, "Structure").
#include <fmt/format.h>

#include "tests/plants/dc_motor.hpp"
#include "tests/plants/dc_motor_model.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("form 2 and form 1 are one square estimator, from 0.3 s on") {
    const DcMotor plant;
    std::vector<std::vector<double>> samples;
    for (const DcMotorSample& s : simulate(plant, 3001)) samples.push_back({s.y, s.u});
    double worst = 0.0;
    for (const double window : {0.3, 0.8, 1.5, 3.0}) {
        const std::vector<std::vector<double>> first(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(window * 1000.0 + 1.5));
        const Estimate one = first_ok(estimates(plan_of(dc_motor_model(window, "exact", 1)), first));
        const Estimate two = first_ok(estimates(plan_of(dc_motor_model(window, "exact", 2)), first));
        const double difference = worst_error(two.parameters, one.parameters);
        fmt::print("DC motor, {} s: the forms differ by {:.1e} (condition {:.1e} and {:.1e})\n", window, difference, one.condition, two.condition);
        worst = std::max(worst, difference);
    }
    CHECK(worst < 1e-7);   // errata.md
}
