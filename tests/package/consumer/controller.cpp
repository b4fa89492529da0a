// SPDX-License-Identifier: MIT-0
// Runs the generated estimator on a simulated coil of 2 ohm and 50 mH under a square wave. Exit 0: found within 1 percent.
#include <cmath>
#include <series_coil/series_coil.hpp>
#include <type_traits>

static_assert(std::is_same_v<decltype(algest::generated::SeriesCoil::Sample::i), float>, "SCALAR float was asked for");

int main() {
    const double R = 2, L = 0.05, period = 1e-3;
    const double decay = std::exp(-R / L * period);
    static algest::generated::SeriesCoil estimator;
    bool found = false;
    double i = 0;
    for (int k = 0; k < 400; ++k) {
        const double v = k / 40 % 2 == 0 ? 1.0 : 0.0;
        algest::generated::SeriesCoil::Sample sample;
        sample.v = static_cast<float>(v);
        sample.i = static_cast<float>(i);
        const auto estimate = estimator.step(sample);
        found = estimate.status == algest::Status::ok && std::abs(estimate.R / R - 1) < 0.01 && std::abs(estimate.L / L - 1) < 0.01;
        i = decay * i + (1 - decay) * v / R;
    }
    return found ? 0 : 1;
}
