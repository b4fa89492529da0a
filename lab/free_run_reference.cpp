// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/free_run_reference.hpp"

#include <algorithm>
#include <cmath>

#include "lab/fit.hpp"
#include "lab/noise.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr double follows = 2;   ///< largest error, in sizes of the sensors' noise, of a run whose parameters are believed: beyond it the model misses something

/// Mean over the outputs of the squared noise over (size of the measured signal)^2: what a fit's cost cannot get below.
double floor_of(const model::Model& model, const Bench& bench) {
    const std::vector<double> noise = noise_by_signal(model, bench);
    const std::vector<int> outputs = scored_outputs(model, bench);
    double out = 0;
    for (const int output : outputs) {
        const auto s = static_cast<std::size_t>(output);
        out += std::pow(noise[s] / size_of(bench.measured[s]), 2) / static_cast<double>(outputs.size());
    }
    return out;
}

}  // namespace

std::optional<std::vector<double>> free_run_reference(const model::Model& model, const Recording& recording) {
    Diagnostics unsaid;   // a model that cannot be run is no fault here
    auto ready = bench(model, recording, unsaid);
    const auto declared = parameter_values(model, {}, unsaid);
    if (!ready || !declared) return std::nullopt;
    Effort effort;
    effort.limit = most_effort;
    ready->options.effort = &effort;
    const Rows all{0, recording.samples()};
    std::vector<FitStart> starts = {{*declared, {}, ready->initial, all}};
    for (const int intervals : weak_intervals(all)) starts.push_back({weak_estimate(model, {{&*ready, all}}, intervals, *declared).parameters, {}, ready->initial, all});
    const auto error = [&](const FitStart& start) {
        const double e = output_error(model, *ready, start);
        return std::isfinite(e) ? e : error_of_divergence * error_of_divergence;
    };
    std::vector<double> errors;
    for (const FitStart& start : starts) errors.push_back(error(start));
    const FitStart& best = starts[static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin())];
    const Fit found = fit(model, *ready, best);
    const bool seen = std::all_of(found.sd.begin(), found.sd.end(), [](double sd) { return std::isfinite(sd); });
    return found.cost <= follows * follows * floor_of(model, *ready) && seen ? std::optional(found.parameters) : std::nullopt;
}

}  // namespace algest::lab
