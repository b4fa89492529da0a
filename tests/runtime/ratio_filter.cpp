// SPDX-License-Identifier: GPL-3.0-or-later
// The ratio filter in single precision on signals that grow and shrink by orders of magnitude.
#include "algest/ratio_filter.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace {

constexpr algest::LowPass<float> filter{true, {0.99f, 0.01f, -0.01f, 0.98f}, {0.005f, 0.005f}, {0.005f, 0.005f}};

struct Filtered {
    explicit Filtered(int unknowns) : n(unknowns), state(static_cast<std::size_t>(algest::ratio_scalars(true, unknowns))) {
        algest::restart_ratio(state.data());
    }
    /// One instant whose signals have this size and whose solution is `value`; what comes out, NaN where nothing does.
    float step(float size, float value) {
        const std::vector<float> pivots(static_cast<std::size_t>(n), 0.5f), scales(static_cast<std::size_t>(n), size);
        std::vector<float> theta(static_cast<std::size_t>(n), value);
        const bool good = algest::filter_ratio(filter, state.data(), pivots.data(), 1, scales.data(), n, theta.data());
        return good ? theta[0] : std::numeric_limits<float>::quiet_NaN();
    }
    int n;
    std::vector<float> state;
};

}  // namespace

TEST_CASE("ratio filter: signals may grow and shrink by any factor") {
    for (int unknowns = 1; unknowns <= 6; ++unknowns) {
        for (const float growth : {10.0f, 1e3f, 1e4f, 1e5f, 1e6f, 1e30f}) {
            INFO(unknowns << " unknowns, growth " << growth);
            Filtered filtered(unknowns);
            CHECK(filtered.step(1e-3f, 1.0f) == Approx(1.0f));
            for (int k = 0; k < 100; ++k) CHECK(filtered.step(1e-3f * growth, 1.0f) == Approx(1.0f));
            float last = 0;
            for (int k = 0; k < 20000; ++k) last = filtered.step(1e-3f, 1.0f);
            CHECK(last == Approx(1.0f));
        }
    }
}

TEST_CASE("ratio filter: slow growth and decay beyond the range of the determinant do not stop it") {
    Filtered filtered(4);
    float size = 1e-8f;   // its determinant, 1e-64, is no float
    for (int k = 0; k < 4000; ++k) CHECK(filtered.step(size *= 1.01f, 2.0f) == Approx(2.0f).epsilon(1e-4));
    for (int k = 0; k < 4000; ++k) CHECK(filtered.step(size /= 1.001f, 2.0f) == Approx(2.0f).epsilon(1e-4));
}

TEST_CASE("ratio filter: a solution that is no number, or too large for one, is gone with the next instant but one") {
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::max()}) {
        Filtered filtered(2);
        for (int k = 0; k < 10; ++k) CHECK(filtered.step(1.0f, 3.0f) == Approx(3.0f));
        (void)filtered.step(1e9f, bad);
        for (int k = 0; k < 10; ++k) CHECK(filtered.step(1.0f, 3.0f) == Approx(3.0f));
    }
}
