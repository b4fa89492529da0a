// SPDX-License-Identifier: GPL-3.0-or-later
// The noisy PMSM over many runs: how far an ok estimate may be off, and how often it is ok, by the way that rows are solved.
#pragma once
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/pmsm_model.hpp"

namespace algest::plants {

struct Spikes {
    std::string what;
    plan::Plan plan;
    double worst = 0.0;   ///< error of an ok estimate, relative, over all parameters
    std::size_t ok = 0, samples = 0;

    double share() const { return static_cast<double>(ok) / static_cast<double>(samples); }
};

/// S(t); the square solve without a test; the same as `generate` makes it where noise is declared: noise may move no unknown by more than 10 percent
/// (one standard deviation); by more than 5 percent.
/// Every `stride`-th sample after both windows are full, 0.4 s, until 0.8 s; noise of 0.03 A. Prints them side by side.
inline std::array<Spikes, 4> spikes(unsigned runs, std::size_t stride) {
    const auto limited = [](const std::string& limit) { return plan_of(changed(pmsm_model("square"), {{"deviation_limit = 0\n", limit}})); };
    std::array<Spikes, 4> all{Spikes{"S(t)", plan_of(pmsm_model("robust"))}, Spikes{"square, no test", plan_of(pmsm_model("square") + "condition_limit = 1e99\nuncertainty = false\n")},
                              Spikes{"square, nothing said", limited("")}, Spikes{"square, deviation_limit = 0.05", limited("deviation_limit = 0.05\n")}};
    Pmsm motor;
    motor.current_noise = 0.03;
    const std::array<double, 3> truth{motor.R, motor.L, motor.K};
    for (motor.seed = 1; motor.seed <= runs; ++motor.seed) {
        const auto samples = inputs(simulate(motor, 8001));
        for (Spikes& s : all) {
            lab::HostEstimator<double> estimator(s.plan);
            for (std::size_t k = 0; k < samples.size(); ++k) {
                estimator.push(samples[k].data());
                if (k < 4000 || (k - 4000) % stride != 0) continue;
                ++s.samples;
                if (estimator.estimate() != Status::ok) continue;
                ++s.ok;
                for (std::size_t p = 0; p < 3; ++p) s.worst = std::max(s.worst, relative_error(estimator.parameters()[p], truth[p]));
            }
        }
    }
    for (const Spikes& s : all) fmt::print("PMSM, noise 0.03 A, {} runs, {}: ok {:.1f} percent, worst ok estimate {:.2g} percent off\n", runs, s.what, 100.0 * s.share(), 100.0 * s.worst);
    return all;
}

}  // namespace algest::plants
