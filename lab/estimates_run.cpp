// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/estimates_run.hpp"

#include <map>
#include <string>
#include <utility>

namespace algest::lab {

namespace {

Recording stretch_of(const Recording& recording, const Replay& replay) {
    const RowRange rows = rows_of(recording, {replay.t.front(), replay.t.back()});
    const auto cut = [&](std::vector<double>& values) {
        values = std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(rows.begin), values.begin() + static_cast<std::ptrdiff_t>(rows.end));
    };
    Recording out = recording;
    cut(out.t);
    for (Column& column : out.columns) cut(column.values);
    return out;
}

}  // namespace

std::optional<EstimatesRun> estimates_run(const model::Model& model, const plan::Plan& plan, const Recording& recording, const Replay& replay, const ReplaySummary& summary, Diagnostics& diagnostics) {
    if (!summary.condition_last) {
        diagnostics.error(recording.file, {}, "no sample has status ok", "");
        return std::nullopt;
    }
    Recording stretch = stretch_of(recording, replay);
    std::map<std::string, double> medians;
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        if (summary.median[p] && model.parameter(plan.parameters[p].name) != nullptr) medians[plan.parameters[p].name] = *summary.median[p];
    }
    auto ready = bench(model, stretch, diagnostics);
    auto parameters = ready ? parameter_values(model, medians, diagnostics) : std::nullopt;
    if (!parameters) return std::nullopt;
    return EstimatesRun{std::move(stretch), std::move(*ready), std::move(*parameters)};
}

}  // namespace algest::lab
