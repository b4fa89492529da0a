// SPDX-License-Identifier: 0BSD
// A control loop with the estimator of coil.toml in it. The coil is simulated: 2 ohm and 50 mH under a square wave of voltage.
// Exit 0: the estimates are right within 1 percent.
#include <cmath>
#include <cstdio>
#include <series_coil/series_coil.hpp>

static algest::generated::SeriesCoil estimator;   // its windows are in it: static, not on the stack

int main() {
    const double R = 2, L = 0.05, period = 1e-3;
    const double decay = std::exp(-R / L * period);
    double current = 0;
    algest::generated::SeriesCoil::Estimate estimate{};
    for (int k = 0; k < 400; ++k) {   // here your interrupt, once a period
        const double voltage = k / 40 % 2 == 0 ? 1.0 : 0.0;
        estimate = estimator.step({static_cast<float>(voltage), static_cast<float>(current)});
        current = decay * current + (1 - decay) * voltage / R;
    }
    if (estimate.status != algest::Status::ok) return 1;
    std::printf("R = %.3f ohm, L = %.4f H\n", static_cast<double>(estimate.R), static_cast<double>(estimate.L));
    return std::abs(estimate.R / R - 1) < 0.01 && std::abs(estimate.L / L - 1) < 0.01 ? 0 : 1;
}
