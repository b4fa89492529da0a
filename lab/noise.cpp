// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/noise.hpp"

#include <algorithm>
#include <cmath>

#include "lab/fit.hpp"

namespace algest::lab {

double roughness(const std::vector<double>& x) {
    if (x.size() < 4) return 0;
    double squares = 0;
    for (std::size_t k = 3; k < x.size(); ++k) {
        const double d = x[k] - 3 * x[k - 1] + 3 * x[k - 2] - x[k - 3];
        squares += d * d;
    }
    return std::sqrt(squares / static_cast<double>(x.size() - 3) / 20.0);   // 1 + 9 + 9 + 1
}

bool declares_noise(const model::Signal& signal) {
    return signal.deviation().has_value();
}

double declared_noise(const model::Signal& signal) { return exact::nearest(*signal.deviation(), plan::Scalar::float64); }

bool guesses_noise(const model::Model& model, const Bench& bench) {
    const auto outputs = scored_outputs(model, bench);
    return std::any_of(outputs.begin(), outputs.end(), [&](int s) { return !declares_noise(model.signals[static_cast<std::size_t>(s)]); });
}

std::vector<double> noise_by_signal(const model::Model& model, const Bench& bench) {
    std::vector<double> out;
    const std::vector<int> simulated = simulated_signals(bench.system);
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const model::Signal& signal = model.signals[s];
        if (bench.measured[s].empty()) out.push_back(0);
        else if (declares_noise(signal)) out.push_back(declared_noise(signal));
        else out.push_back(std::find(simulated.begin(), simulated.end(), static_cast<int>(s)) != simulated.end() ? roughness(bench.measured[s]) : 0);
    }
    return out;
}

}  // namespace algest::lab
