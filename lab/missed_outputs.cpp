// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/missed_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "lab/estimates_run.hpp"
#include "lab/fit.hpp"
#include "lab/median.hpp"
#include "lab/noise.hpp"
#include "lab/white_noise.hpp"

namespace algest::lab {

namespace {

constexpr double push = 0.01;       ///< of each state's size: a disturbed start
constexpr double forgotten = 0.3;   ///< of the push, what may be left of it on average over the second half
constexpr std::size_t stretches = 8;   ///< of the ok estimates: a change in the last eighth is seen
constexpr std::size_t fewest = 100;    ///< samples of a run, and ok estimates, that say something

double rms_of_difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t from, std::size_t to) {
    double squares = 0;
    for (std::size_t k = from; k < to; ++k) squares += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(squares / static_cast<double>(to - from));
}

/// What the median of parameter p may be off by: half the range of the medians of `stretches` stretches of time, and the bias that noise gives the last estimate. A
/// parameter that changes shows in it at its full size, what differs from window to window as far as it does not average out.
double uncertainty(const Replay& replay, const ReplaySummary& summary, std::size_t p) {
    std::vector<double> values;
    for (std::size_t k = 0; k < replay.samples(); ++k) if (replay.status[k] == Status::ok) values.push_back(replay.parameter(k, p));
    double low = *summary.median[p];
    double high = low;
    for (std::size_t part = 0; part < stretches; ++part) {
        const auto at = [&](std::size_t of) { return values.begin() + static_cast<std::ptrdiff_t>(of * values.size() / stretches); };
        const auto middle = median({at(part), at(part + 1)});
        low = std::min(low, middle.value_or(low));
        high = std::max(high, middle.value_or(high));
    }
    return 0.5 * (high - low) + std::abs(summary.bias[p].value_or(0.0));
}

/// By the model's parameters; nullopt where one of them has no estimate.
std::optional<std::vector<double>> uncertainties(const model::Model& model, const plan::Plan& plan, const Replay& replay, const ReplaySummary& summary) {
    std::vector<double> out;
    for (const model::Parameter& parameter : model.parameters) {
        const auto p = std::find_if(plan.parameters.begin(), plan.parameters.end(), [&](const plan::Parameter& q) { return q.name == parameter.name; });
        if (p == plan.parameters.end() || !summary.median[static_cast<std::size_t>(p - plan.parameters.begin())]) return std::nullopt;
        out.push_back(uncertainty(replay, summary, static_cast<std::size_t>(p - plan.parameters.begin())));
    }
    return out;
}

/// Where a run cannot be held against the model: a state starts nobody knows where, a sensor is late, or an equation leaves a perturbation open.
bool says_nothing(const model::Model& model, const Bench& bench) {
    return std::any_of(bench.system.states.begin(), bench.system.states.end(), [&](const StateEntry& e) { return bench.measured[static_cast<std::size_t>(e.signal)].empty(); }) ||
           std::any_of(model.signals.begin(), model.signals.end(), [](const model::Signal& s) { return s.lag > 0; }) ||
           std::any_of(model.equations.begin(), model.equations.end(), [](const model::Equation& e) { return e.kappa > 0; });
}

/// The inputs with their declared noise once more.
Drive noisier(const model::Model& model, const Bench& bench) {
    Drive out = bench.drive;
    std::mt19937 random(1);   // NOLINT(cert-msc32-c,cert-msc51-cpp): the same answer on each run
    for (std::size_t s = 0; s < out.values.size(); ++s) {
        if (out.values[s].empty() || !declares_noise(model.signals[s])) continue;
        add_white_noise(out.values[s], noise_by_signal(model, bench)[s], random);
    }
    return out;
}

/// From a disturbed start, with noisier inputs, and with each parameter moved by what it is uncertain by.
std::vector<FreeRun> disturbed_runs(const model::Model& model, const Bench& bench, const std::vector<double>& parameters, const std::vector<double>& uncertain, const RunOptions& options) {
    std::vector<FreeRun> out;
    std::vector<double> start = bench.initial;
    for (std::size_t i = 0; i < start.size(); ++i) start[i] += push * bench.options.scale[i];
    out.push_back(free_run(bench.system, parameters, start, bench.drive, options));
    out.push_back(free_run(bench.system, parameters, bench.initial, noisier(model, bench), options));
    for (std::size_t p = 0; p < uncertain.size(); ++p) {
        std::vector<double> moved = parameters;
        moved[p] += uncertain[p];
        out.push_back(free_run(bench.system, moved, bench.initial, bench.drive, options));
    }
    return out;
}

/// As many samples as `runs` runs can have.
std::size_t samples_within(const Bench& bench, double runs) {
    const double evaluations = 6.0 * static_cast<double>(bench.system.moving.size()) + 1.0;   // of a step a sample (free_run.hpp)
    const double most = most_effort_of_a_look / (runs * evaluations * static_cast<double>(std::max<std::size_t>(bench.system.residual.operations.size(), 1)));
    return static_cast<std::size_t>(std::min(static_cast<double>(bench.drive.samples), most));
}

}  // namespace

std::vector<MissedOutput> missed_outputs(const model::Model& model, const plan::Plan& plan, const Recording& recording, const Replay& replay, const ReplaySummary& summary) {
    Diagnostics unsaid;   // a model that cannot be run is no fault here
    if (plan.discrete || model.filter || summary.count[static_cast<std::size_t>(Status::ok)] < fewest) return {};
    const auto ready = estimates_run(model, plan, recording, replay, summary, unsaid);
    const auto uncertain = uncertainties(model, plan, replay, summary);
    if (!ready || !uncertain || says_nothing(model, ready->bench)) return {};
    const Bench& bench = ready->bench;
    const std::vector<int> outputs = scored_outputs(model, bench);
    if (std::none_of(outputs.begin(), outputs.end(), [&](int s) { return declares_noise(model.signals[static_cast<std::size_t>(s)]); })) return {};   // no yardstick
    RunOptions options = bench.options;
    options.end = samples_within(bench, static_cast<double>(uncertain->size()) + 3);
    if (options.end < fewest) return {};
    const FreeRun median = free_run(bench.system, ready->parameters, bench.initial, bench.drive, options);
    if (median.samples < options.end) return {};
    const std::vector<FreeRun> others = disturbed_runs(model, bench, ready->parameters, *uncertain, options);
    const std::vector<double> noise = noise_by_signal(model, bench);
    const std::size_t from = options.end / 2;
    std::vector<MissedOutput> out;
    for (const OutputError& o : output_errors(model, bench, median, from, options.end)) {
        const auto s = static_cast<std::size_t>(o.signal);
        if (!declares_noise(model.signals[s])) continue;
        double squares = noise[s] * noise[s];
        bool known = true;
        for (const FreeRun& other : others) {
            known = known && other.samples == median.samples;   // a run that diverges says that this one may
            if (!known) break;
            const double moved = rms_of_difference(other.signals[s], median.signals[s], from, options.end);
            if (&other == &others.front()) known = moved < forgotten * push * size_of(bench.measured[s]);
            squares += moved * moved;
        }
        const double explained = std::sqrt(squares);
        if (known && o.rmse > missed_floors * noise[s] && o.nrmse > missed_share && o.rmse > missed_beyond_uncertainty * explained) {
            out.push_back({model.signals[s].name, model.signals[s].unit, o.rmse, o.rmse / noise[s], o.nrmse, ready->stretch.t[from], ready->stretch.t[options.end - 1]});
        }
    }
    return out;
}

}  // namespace algest::lab
