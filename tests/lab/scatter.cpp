// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/scatter.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace algest;

namespace {

/// `samples` ok estimates, normal about 3 with `times` the deviation 0.2 that they state, at every `every`-th sample.
lab::Replay replay_of(std::size_t samples, double times, std::size_t every = 1) {
    std::mt19937 dice(11);
    std::normal_distribution<double> normal(0.0, 1.0);
    lab::Replay out{};
    out.parameter_count = 1;
    for (std::size_t k = 0; k < samples; ++k) {
        out.t.push_back(static_cast<double>(k));
        out.status.push_back(Status::ok);
        out.condition.push_back(1.0);
        out.parameters.push_back(3.0 + 0.2 * times * normal(dice));
        out.deviations.push_back(k % every == 0 ? 0.2 : std::numeric_limits<double>::quiet_NaN());
    }
    return out;
}

}  // namespace

TEST_CASE("scatter of estimates in their own deviations") {
    // 32 to 64 are looked at: the median of as many |normal| numbers has a relative deviation of 1.17 sqrt(1/64) to sqrt(1/32), 15 to 21 percent; thrice that
    CHECK(*lab::scatter_in_deviations(replay_of(4096, 1.0), 0) == Approx(1.0).margin(0.6));
    CHECK(*lab::scatter_in_deviations(replay_of(4096, 30.0), 0) == Approx(30.0).margin(18.0));
    CHECK(*lab::scatter_in_deviations(replay_of(4096, 30.0), 0) > lab::more_than_noise);
    CHECK_FALSE(lab::scatter_in_deviations(replay_of(7, 1.0), 0));
    CHECK(lab::scatter_in_deviations(replay_of(8, 1.0), 0));
    lab::Replay without = replay_of(4096, 1.0);
    without.deviations.clear();
    CHECK_FALSE(lab::scatter_in_deviations(without, 0));
}

TEST_CASE("scatter does not depend on how many deviations were added") {
    const std::size_t samples = 5000;
    const std::size_t few = lab::deviation_stride(samples, lab::deviations_for_scatter), many = lab::deviation_stride(samples, 500);
    CHECK(few % many == 0);
    CHECK(few > many);
    CHECK(samples / few >= lab::deviations_for_scatter);
    CHECK(lab::scatter_in_deviations(replay_of(samples, 1.0, few), 0) == lab::scatter_in_deviations(replay_of(samples, 1.0, many), 0));
}
