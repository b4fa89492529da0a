// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of a steady state: what ends one, what drops one, and that a constant is its own mean.
#include "algest/steady_state.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <limits>
#include <vector>

using namespace algest;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The means of all blocks of one quantity; stretch(k) numbers the stretches.
std::vector<double> means(int samples, int block, double tolerance, const std::function<double(int)>& value, const std::function<double(int)>& stretch = [](int) { return 1.0; }) {
    std::vector<double> state(static_cast<std::size_t>(steady_scalars(1)), 0.0);
    SteadyProgress progress = {0, 0};
    std::vector<double> out;
    for (int k = 0; k < samples; ++k) {
        const double x = value(k);
        double mean = -1;
        if (average_steady(state.data(), progress, &tolerance, 1, block, stretch(k), &x, &mean)) out.push_back(mean);
    }
    return out;
}

}  // namespace

TEST_CASE("steady state: a constant is its own mean to the last bit, block after block") {
    for (const double c : {0.1, -1.0 / 3, 1e300, 5e-324}) CHECK(means(31, 7, 0.0, [&](int) { return c; }) == std::vector<double>(4, c));
}

TEST_CASE("steady state: means of whole blocks") {
    CHECK(means(12, 4, never, [](int k) { return static_cast<double>(k); }) == std::vector<double>{1.5, 5.5, 9.5});
    const std::vector<double> oscillating = means(16, 8, 1e-12, [](int k) { return k % 2 == 0 ? 1.0 : 2.0; });   // every quarter has the same mean
    CHECK(oscillating == std::vector<double>{1.5, 1.5});
}

TEST_CASE("steady state: a drift within the tolerance is steady, beyond it is not") {
    const auto ramp = [](int k) { return 0.1 * k; };
    // Quarters of 2 samples: their means rise by 0.2 each, 0.6 over the block.
    CHECK(means(8, 8, 0.61, ramp).size() == 1);
    CHECK(means(80, 8, 0.59, ramp).empty());
}

TEST_CASE("steady state: after a step the next block begins at the next quarter") {
    const auto step = [](int k) { return k < 5 ? 0.0 : 1.0; };
    // Samples 0 to 5 end their third quarter unsteady; the next block is 6 to 13.
    CHECK(means(14, 8, 0.1, step) == std::vector<double>{1.0});
    CHECK(means(13, 8, 0.1, step).empty());
}

TEST_CASE("steady state: a block lies within one stretch, and none is outside of them") {
    const auto value = [](int k) { return static_cast<double>(k); };
    const auto stretch = [](int k) { return k < 3 ? 0.0 : k < 9 ? 1.0 : 2.0; };   // 3 to 8, then 9 to 13
    CHECK(means(14, 4, never, value, stretch) == std::vector<double>{4.5, 10.5});
    CHECK(means(50, 4, never, value, [](int) { return 0.0; }).empty());
}
