// SPDX-License-Identifier: GPL-3.0-or-later
// The committed estimators of the machines that were measured, on simulations of them, where the truth is known.
#include <fmt/format.h>

#include "generated/pendulum/pendulum.hpp"
#include "generated/positioning_axis/positioning_axis.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/pendulum.hpp"
#include "tests/plants/positioning_axis.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("pendulum: the committed estimator") {
    const Pendulum plant;
    generated::Pendulum estimator;
    generated::Pendulum::Estimate e{};
    const std::vector<double> angle = simulate(plant, 3001);
    for (std::size_t k = 0; k < angle.size(); ++k) {
        e = estimator.step({angle[k]});
        if (k < 500) {
            REQUIRE(e.status == Status::filling);
            continue;
        }
        REQUIRE(e.status == Status::ok);
        // sin(theta) goes straight between samples up to (omega T)^2 / 12 = 5e-6, and in the same way as theta itself
        REQUIRE(relative_error(e.gravity, plant.gravity) < 1e-6);
        REQUIRE(relative_error(e.damping, plant.damping) < 1e-4);
    }
    fmt::print("pendulum, simulated: gravity {:.1e}, damping {:.1e}\n", relative_error(e.gravity, plant.gravity),
               relative_error(e.damping, plant.damping));
}

TEST_CASE("positioning axis: the committed estimator") {
    const PositioningAxis plant;
    generated::PositioningAxis estimator;
    generated::PositioningAxis::Estimate e{};
    for (const AxisSample& s : simulate(plant, 6001)) e = estimator.step({s.q, s.force});
    REQUIRE(e.status == Status::ok);
    const std::vector<double> found{e.M, e.Fv, e.Fc, e.offset};
    const std::vector<double> truth{plant.M, plant.Fv, plant.Fc, plant.offset};
    fmt::print("positioning axis, simulated: M {:.1e}, Fv {:.1e}, Fc {:.1e}, offset {:.1e}\n", relative_error(e.M, plant.M),
               relative_error(e.Fv, plant.Fv), relative_error(e.Fc, plant.Fc), relative_error(e.offset, plant.offset));
    // The sign of the speed changes within a sample, and is known one sample late: of the 200 samples of a window with a change
    // in it one is wrong by half, at 6 of 3000 instants: a few 1e-4
    CHECK(worst_error(found, truth) < 2e-3);
}
