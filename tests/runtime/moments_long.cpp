// SPDX-License-Identifier: GPL-3.0-or-later
// Windowed moments after a hundred million samples: three hours at 10 kHz.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "tests/runtime/moment_window.hpp"

using namespace algest::test;

TEST_CASE("moments do not drift in a hundred million samples") {
    constexpr int intervals = 2000;
    constexpr Rule linear{algest::plan::Hold::linear, algest::plan::Quadrature::exact};
    for (const int degree : {6, 10}) {
        const auto kernels = nine_kernels(degree);
        MomentWindow<double, double> window(kernels, intervals, linear);
        Comparison<double> comparison(kernels, intervals, linear);
        constexpr long last = 100'000'000;
        for (long k = 0; k < last; ++k) {
            window.push(moment_signal(k));
            if (k > last - 3 * intervals && k % 101 == 0) comparison.look(window);
        }
        fmt::print("moments, double, d = {}, M = 2000, after 1e8 samples: {:.1e}\n", degree, comparison.worst());
        CHECK(comparison.worst() < 1e-11);
    }
}
