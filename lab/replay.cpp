// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "lab/csv_text.hpp"
#include "lab/host_estimator.hpp"
#include "lab/median.hpp"

namespace algest::lab {

namespace {

bool check_length(const plan::Plan& plan, const Recording& recording, RowRange rows, Diagnostics& diagnostics) {
    const int needed = plan.samples_to_first_estimate();
    if (rows.size() >= static_cast<std::size_t>(needed)) return true;
    const bool whole = rows.size() == recording.samples();
    diagnostics.error(
        recording.file, {static_cast<int>(rows.end) + 1, 1},
        fmt::format("{} samples {}, and the estimator `{}` gives its first estimate after {} ({:.6g} s)", rows.size(),
                    whole ? "in the recording" : "between --from and --to", plan.name, needed, needed * plan.period),
        whole ? "a longer recording, or a shorter `window` in the model"
              : fmt::format("a longer stretch; the recording goes from {:.6g} s to {:.6g} s", recording.t.front(),
                            recording.t.back()));
    return false;
}

template <class S>
Replay run(const plan::Plan& plan, const Recording& recording, const std::vector<std::vector<double>>& inputs, RowRange rows,
           const ProgressReport& progress) {
    constexpr std::size_t samples_between_reports = 512;
    HostEstimator<S> estimator(plan);
    Replay out{{}, {}, {}, {}, plan.parameters.size(), {}, {}, {}, {}};
    out.points.quantities = plan.steady ? plan.steady->averaged.size() : 0;
    out.t.reserve(rows.size());
    out.status.reserve(rows.size());
    out.condition.reserve(rows.size());
    out.parameters.reserve(rows.size() * out.parameter_count);
    std::vector<S> sample(inputs.size());
    for (std::size_t k = rows.begin; k < rows.end; ++k) {
        for (std::size_t i = 0; i < inputs.size(); ++i) sample[i] = static_cast<S>(inputs[i][k]);
        const std::size_t points = estimator.points();
        estimator.step(sample.data());
        if (estimator.points() != points) out.points.means.insert(out.points.means.end(), estimator.point().begin(), estimator.point().end());
        out.t.push_back(recording.t[k]);
        out.status.push_back(estimator.status());
        out.condition.push_back(static_cast<double>(estimator.condition()));
        for (const S value : estimator.parameters()) out.parameters.push_back(static_cast<double>(value));
        if (progress && (k - rows.begin) % samples_between_reports == 0) {
            progress(static_cast<double>(k - rows.begin) / static_cast<double>(rows.size()));
        }
    }
    if (plan.elimination) out.candidates = named_candidates(plan, estimator.candidates());
    return out;
}

template <class S>
void run_deviations(const plan::Plan& plan, const std::vector<std::vector<double>>& inputs, std::size_t begin, std::size_t most, Replay& replay,
                    const ProgressReport& progress) {
    const auto last = std::find(replay.status.rbegin(), replay.status.rend(), Status::ok);
    if (last == replay.status.rend()) return;
    const std::size_t samples = static_cast<std::size_t>(replay.status.rend() - last);
    const std::size_t stride = deviation_stride(static_cast<std::size_t>(std::count(replay.status.begin(), replay.status.end(), Status::ok)), most);
    std::size_t ok = 0;
    replay.deviations.assign(replay.parameters.size(), std::numeric_limits<double>::quiet_NaN());
    replay.biases = replay.deviations;
    HostEstimator<S> estimator(plan);
    std::vector<S> sample(inputs.size());
    for (std::size_t k = 0; k < samples; ++k) {
        for (std::size_t i = 0; i < inputs.size(); ++i) sample[i] = static_cast<S>(inputs[i][begin + k]);
        estimator.step(sample.data());
        if (estimator.status() != Status::ok) continue;
        const bool chosen = most > 1 && ok++ % stride == 0;
        if (!(chosen || k + 1 == samples) || estimator.uncertainty() != Status::ok) continue;
        for (int p = 0; p < plan.estimated(); ++p) {
            const std::size_t place = k * replay.parameter_count + static_cast<std::size_t>(p);
            replay.deviations[place] = static_cast<double>(estimator.deviation()[static_cast<std::size_t>(p)]);
            replay.biases[place] = static_cast<double>(estimator.bias()[static_cast<std::size_t>(p)]);
        }
        if (progress) progress(static_cast<double>(k) / static_cast<double>(samples));
    }
}

template <class S>
std::string csv(const plan::Plan& plan, const Replay& replay) {
    std::string out = "t [s],status,condition";
    for (const plan::Parameter& p : plan.parameters) {
        out += "," + csv_heading(p.name, p.unit);
    }
    const std::size_t deviations = replay.deviations.empty() ? 0 : static_cast<std::size_t>(plan.estimated());
    for (std::size_t p = 0; p < deviations; ++p) out += "," + csv_heading("sd(" + plan.parameters[p].name + ")", plan.parameters[p].unit);
    out += "\n";
    for (std::size_t k = 0; k < replay.samples(); ++k) {
        append_number<double>(out, replay.t[k]);
        out += ",";
        out += name(replay.status[k]);
        out += ",";
        append_number<S>(out, replay.condition[k]);
        for (std::size_t p = 0; p < replay.parameter_count; ++p) {
            out += ",";
            append_number<S>(out, replay.parameter(k, p));
        }
        for (std::size_t p = 0; p < deviations; ++p) {
            out += ",";
            append_number<S>(out, replay.deviation(k, p));
        }
        out += "\n";
    }
    return out;
}

}  // namespace

std::optional<Replay> replay(const plan::Plan& plan, const Recording& recording, const Stretch& stretch,
                             Diagnostics& diagnostics, const ProgressReport& progress) {
    std::vector<std::vector<double>> inputs;
    const RowRange rows = rows_of(recording, stretch);
    const bool signals_fit = read_inputs(plan, recording, inputs, diagnostics);
    const bool period_fits = check_period(recording, plan.name, plan.period, diagnostics);
    if (!signals_fit || !period_fits || !check_length(plan, recording, rows, diagnostics)) return std::nullopt;
    return plan.scalar == plan::Scalar::float64 ? run<double>(plan, recording, inputs, rows, progress)
                                                : run<float>(plan, recording, inputs, rows, progress);
}

std::size_t deviation_stride(std::size_t ok, std::size_t most) {
    std::size_t stride = 1;
    while (2 * stride * std::max<std::size_t>(most, 1) <= ok) stride *= 2;
    return stride;
}

void add_deviations(const plan::Plan& plan, const Recording& recording, std::size_t most, Replay& replay, const ProgressReport& progress) {
    if (!plan.uncertain() || replay.t.empty()) return;
    Diagnostics said_before;   // by replay(), which read the same columns
    std::vector<std::vector<double>> inputs;
    if (!read_inputs(plan, recording, inputs, said_before)) return;
    const std::size_t begin = rows_of(recording, {replay.t.front(), replay.t.back()}).begin;
    if (plan.scalar == plan::Scalar::float64) run_deviations<double>(plan, inputs, begin, most, replay, progress);
    else run_deviations<float>(plan, inputs, begin, most, replay, progress);
}

ReplaySummary summarise(const Replay& replay) {
    ReplaySummary out;
    for (const Status s : replay.status) ++out.count[static_cast<std::size_t>(s)];
    std::vector<std::size_t> ok;
    for (std::size_t k = 0; k < replay.samples(); ++k) {
        if (replay.status[k] == Status::ok) ok.push_back(k);
    }
    std::vector<double> values(ok.size());
    for (std::size_t p = 0; p < replay.parameter_count; ++p) {
        out.last.push_back(ok.empty() ? std::nullopt : std::optional(replay.parameter(replay.samples() - 1, p)));   // before: an initial value
        std::transform(ok.begin(), ok.end(), values.begin(), [&](std::size_t k) { return replay.parameter(k, p); });
        out.median.push_back(median(values));
        const bool known = !ok.empty() && !replay.deviations.empty() && std::isfinite(replay.deviation(ok.back(), p));
        out.deviation.push_back(known ? std::optional(replay.deviation(ok.back(), p)) : std::nullopt);
        out.bias.push_back(known ? std::optional(replay.bias(ok.back(), p)) : std::nullopt);
    }
    std::transform(ok.begin(), ok.end(), values.begin(), [&](std::size_t k) { return replay.condition[k]; });
    out.condition_median = median(values);
    if (!ok.empty()) out.condition_last = replay.condition[ok.back()];
    return out;
}

std::string replay_csv(const plan::Plan& plan, const Replay& replay) {
    return plan.scalar == plan::Scalar::float64 ? csv<double>(plan, replay) : csv<float>(plan, replay);
}

}  // namespace algest::lab
