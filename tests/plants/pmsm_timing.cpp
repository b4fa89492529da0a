// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 6 of issue 4: R, L and K with ideal currents, by the frame in which the drive holds a command.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/plants/estimates.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/pmsm_model.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

constexpr int samples_of_08s = 8001;

/// R, L, K.
struct Errors {
    std::array<double, 3> median, worst;

    double largest_median() const { return *std::max_element(median.begin(), median.end()); }
    double largest() const { return *std::max_element(worst.begin(), worst.end()); }
};

/// Over the second half of 0.8 s.
Errors errors_of(const std::string& solve, const Pmsm& motor, const std::vector<PmsmSample>& samples,
                 const std::string& what) {
    const auto all = estimates(plan_of(pmsm_model(solve)), inputs(samples));
    const std::array<double, 3> truth{motor.R, motor.L, motor.K};
    Errors out{};
    for (std::size_t p = 0; p < 3; ++p) {
        const auto e = errors(all, all.size() / 2, p, truth[p]);
        out.median[p] = median(e);
        out.worst[p] = worst(e);
    }
    const auto& [m, w] = out;
    fmt::print("PMSM, {:41} {:6}: median R {:.1e}, L {:.1e}, K {:.1e}; worst {:.1e}, {:.1e}, {:.1e}\n", what, solve, m[0],
               m[1], m[2], w[0], w[1], w[2]);
    return out;
}

/// A command without advance as it acts on the way: the rotor is half a sample further on than where the command was laid.
std::vector<PmsmSample> as_it_acts(const Pmsm& motor, std::vector<PmsmSample> samples) {
    for (PmsmSample& s : samples) {
        const double half = 0.5 * motor.n_p * s.omega * motor.period;
        const pmsm_drive::RotorFrame v = pmsm_drive::to_rotor_frame({s.v_d, s.v_q}, half);
        s.v_d = v.d;
        s.v_q = v.q;
    }
    return samples;
}

}  // namespace

TEST_CASE("PMSM: commands held in the rotor frame and in the stator frame, with and without half a sample of advance") {
    Pmsm motor;
    const auto in_rotor = simulate(motor, samples_of_08s);
    motor.hold = Hold::stator_frame;
    const auto in_stator = simulate(motor, samples_of_08s);
    motor.hold = Hold::stator_frame_no_advance;
    const auto late = simulate(motor, samples_of_08s);

    // The bars of the issue. The square solve is singular now and then: its medians.
    CHECK(errors_of("robust", motor, in_rotor, "rotor frame").largest() < 1e-4);
    CHECK(errors_of("square", motor, in_rotor, "rotor frame").largest_median() < 1e-4);
    CHECK(errors_of("robust", motor, in_stator, "stator frame, half a sample ahead").largest() < 8e-4);
    CHECK(errors_of("square", motor, in_stator, "stator frame, half a sample ahead").largest_median() < 1.2e-3);
    auto fed = in_stator;
    for (PmsmSample& s : fed) {
        const pmsm_drive::RotorFrame v = pmsm_drive::fed_for_stator_hold({s.v_d, s.v_q}, motor.n_p * s.omega, motor.period);
        s.v_d = v.d;
        s.v_q = v.q;
    }
    // What is left is the resistance's share of the bend of the currents: phi R T / (12 L) = 3e-4 of the voltage, across the axes.
    CHECK(errors_of("robust", motor, fed, "stator frame, ahead, fed with phi^2/24").largest() < 3e-4);
    CHECK(errors_of("square", motor, fed, "stator frame, ahead, fed with phi^2/24").largest_median() < 3e-4);
    for (const char* solve : {"robust", "square"}) {
        const double error = errors_of(solve, motor, late, "stator frame, no advance").largest_median();
        CHECK(error > 1.5e-2);
        CHECK(error < 3.05e-2);  // 3 percent, to the digits of the issue
    }
    // A drive that cannot be changed: the same angle, taken off what the estimator is fed.
    const auto turned = as_it_acts(motor, late);
    CHECK(errors_of("robust", motor, turned, "stator frame, no advance, fed as it acts").largest() < 8e-4);
    CHECK(errors_of("square", motor, turned, "stator frame, no advance, fed as it acts").largest_median() < 1.2e-3);
}
