// SPDX-License-Identifier: GPL-3.0-or-later
// How a variant is fitted: from which parameters and initial states on, and over which rows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/variant.hpp"

namespace algest::lab {

namespace {

constexpr double search_accuracy = 1e-4;        ///< relative change of a cost at which a fit of the search stops
constexpr int search_iterations = 12;
constexpr int iterations_from_elsewhere = 40;
constexpr double hopeless = 0.3;                ///< nrmse of a fit from which on it is tried from elsewhere
constexpr std::size_t first_of_the_rows = 8;    ///< part of them that a growing fit begins with: chosen

/// The rows of an equation that is not linear in a parameter take its initial value: that becomes what was fitted.
void start_at_fit(Variant& v) {
    for (std::size_t p = 0; p < v.model.parameters.size(); ++p) if (std::isfinite(v.fit.parameters[p])) v.model.parameters[p].initial = exact::from_double(v.fit.parameters[p]);
}

std::vector<double> declared_values(const model::Model& model) {
    std::vector<double> out;
    for (const model::Parameter& p : model.parameters) out.push_back(exact::nearest(*p.initial, plan::Scalar::float64));
    return out;
}

/// True where an input that is delayed does not begin with 0.
bool past_matters(const Bench& bench) {
    return std::any_of(bench.system.delays.begin(), bench.system.delays.end(), [&](const DelayedSignal& d) {
        const std::vector<double>& recorded = bench.drive.values[static_cast<std::size_t>(d.signal)];
        return !d.moves && !recorded.empty() && recorded[0] != 0;
    });
}

/// What the recordings beyond the first say of their initial states.
std::vector<std::vector<double>> own_starts(const Variant& v) {
    std::vector<std::vector<double>> out;
    for (const Bench& bench : v.further) out.push_back(bench.initial);
    return out;
}

/// With every run starting where its recording says.
FitStart at_recorded_states(const Variant& v, FitStart from) {
    from.initial = v.bench.initial;
    for (std::size_t r = 0; r < from.further.size(); ++r) from.further[r].initial = v.further[r].initial;
    return from;
}

/// Of these parameters those that leave the least error over the rows of `at`; the first where none leaves a number.
std::vector<double> nearest(const Variant& v, FitStart at, const std::vector<std::vector<double>>& candidates) {
    std::vector<double> out = candidates[0];
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& parameters : candidates) {
        at.parameters = parameters;
        const double error = output_error(v.model, v.bench, at);
        if (!(error < least)) continue;
        least = error;
        out = parameters;
    }
    return out;
}

}  // namespace

void Workbench::fit_and_score(Variant& v, const std::vector<double>& start, const std::vector<double>& initial) const {
    if (yardstick_ == Yardstick::rows) {
        const WeakEstimate estimate = weak_estimate(v.model, stretches(v, &Parts::fitted), row_intervals(parts().validation), start);
        v.fit = {estimate.parameters, estimate.sd, initial, 0, true, 0, own_starts(v)};
        v.score = rows_score(v, &Parts::validation);
        return;
    }
    v.fit = {start, {}, initial, 0, false, 0, own_starts(v)};
    FitStart from = start_of(v, v, &Parts::fitted);
    from.most_iterations = search_iterations;
    from.tolerance = search_accuracy;
    std::vector<std::vector<double>> starts = weak_parameters(v, start);
    starts.insert(starts.begin(), start);
    from.parameters = nearest(v, from, starts);
    fit_either_past(v, from);
    if (!(v.fit.cost < hopeless * hopeless)) fit_from_elsewhere(v, from);
    start_at_fit(v);
    v.score = free_run_score(v, &Parts::validation);
}

/// What the rows say, by each length of their windows, from `start` on.
std::vector<std::vector<double>> Workbench::weak_parameters(const Variant& v, const std::vector<double>& start) const {
    std::vector<std::vector<double>> out;
    for (const int intervals : weak_intervals(parts().fitted)) out.push_back(weak_estimate(v.model, stretches(v, &Parts::fitted), intervals, start).parameters);
    return out;
}

/// What a delayed input was before the first sample nobody recorded: its first value, or 0, whichever the fit is nearer with, recording by recording.
void Workbench::fit_either_past(Variant& v, const FitStart& from) const {
    v.fit = fit(v.model, v.bench, from);
    for (std::size_t r = 0; r < recordings(); ++r) {
        Bench& bench = r == 0 ? v.bench : v.further[r - 1];
        if (!past_matters(bench)) continue;
        bench.drive.from_rest = !bench.drive.from_rest;
        Fit other = fit(v.model, v.bench, from);
        if (other.cost < v.fit.cost) v.fit = std::move(other);
        else bench.drive.from_rest = !bench.drive.from_rest;
    }
}

/// A fit that explains next to nothing is caught in a false minimum, or the model is wrong from the start: values that were declared, and
/// what rows alone say, are tried as they are.
void Workbench::fit_from_elsewhere(Variant& v, const FitStart& from) const {
    std::vector<std::vector<double>> starts = {declared_values(v.model)};
    for (std::vector<double>& parameters : weak_parameters(v, starts[0])) starts.push_back(std::move(parameters));
    FitStart elsewhere = at_recorded_states(v, from);
    elsewhere.parameters = nearest(v, elsewhere, starts);
    elsewhere.most_iterations = iterations_from_elsewhere;
    Fit other = fit(v.model, v.bench, elsewhere);
    if (other.cost < v.fit.cost) v.fit = std::move(other);
}

void Workbench::fit_growing(Variant& v) const {
    if (yardstick_ == Yardstick::rows) return;
    FitStart from = at_recorded_states(v, start_of(v, v, &Parts::fitted));
    from.most_iterations = search_iterations;
    from.tolerance = search_accuracy;
    const auto over = [&](std::size_t part) {
        FitStart out = from;
        out.rows.end = out.rows.begin + out.rows.size() / part;
        for (FurtherRun& run : out.further) run.rows.end = run.rows.begin + run.rows.size() / part;
        return out;
    };
    from.parameters = nearest(v, over(first_of_the_rows), weak_parameters(v, v.fit.parameters));
    Fit other;
    for (std::size_t part = first_of_the_rows; part > 0; part /= 2) {
        other = fit(v.model, v.bench, over(part));
        from.parameters = other.parameters;
        from.initial = other.initial;
        for (std::size_t r = 0; r < from.further.size(); ++r) from.further[r].initial = other.further_initial[r];
    }
    if (!(other.cost < v.fit.cost)) return;
    v.fit = std::move(other);
    start_at_fit(v);
    v.score = free_run_score(v, &Parts::validation);
}

void Workbench::refine(Variant& v) {
    begin_check();
    FitStart from = start_of(v, v, &Parts::train);
    if (yardstick_ == Yardstick::rows) {   // the run gets the initial values that suit it, the parameters stay those of the rows
        const WeakEstimate estimate = weak_estimate(v.model, stretches(v, &Parts::train), row_intervals(parts().validation), v.fit.parameters);
        from.parameters = estimate.parameters;
        from.fixed.assign(estimate.parameters.size(), true);
        v.fit = fit(v.model, v.bench, from);
        v.fit.sd = estimate.sd;
        return;
    }
    v.fit = fit(v.model, v.bench, from);
    start_at_fit(v);
}

}  // namespace algest::lab
