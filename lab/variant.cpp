// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "lab/largest_size.hpp"
#include "lab/noise.hpp"

namespace algest::lab {

namespace {

constexpr double fit_share = 0.7;               ///< of the training rows are fitted, the rest validate
constexpr std::size_t least_train = 100;        ///< rows
constexpr std::size_t least_test = 10;
constexpr double search_tolerance = 1e-6;       ///< of the runs of a search: far below any sensor's noise
constexpr double finest_part = 1e-4;
constexpr double effort_of_a_search = 1e10;     ///< operations of tapes: 15 s
constexpr double share_of_a_candidate = 0.15;   ///< chosen: a search survives six that are stiff
constexpr double effort_of_a_last_fit = 2e9;
constexpr std::size_t rows_of_an_undriven_run = 4000;
constexpr double lasting = 0.3;                 ///< share of a disturbed start that is still there a third of the way on: it does not fade
constexpr int intervals_of_a_row = 64;          ///< of the windows that score equations, shorter where they would be too few
constexpr double share_of_white = 0.7;          ///< of the rows, that count as independent ones: autocorrelation of noise alone
constexpr std::size_t least_windows = 100;      ///< half overlapping, that score an equation

void names_in(const formula::Formula& f, std::set<std::string>& out) {
    if (f->kind == formula::Kind::name) out.insert(f->name);
    for (const formula::Formula& a : f->arguments) names_in(a, out);
}

/// Of two signals that an amendment bends the difference of, how small that is beside them: so much finer the run has to be.
double smallest_part(const std::vector<Amendment>& amendments, const model::Model& model, const Bench& bench) {
    double out = 1;
    for (const Amendment& a : amendments) {
        for (const Substitution& s : a.substitutions) {
            if (s.what[0] != '(') continue;
            const std::string first = s.what.substr(1, s.what.find('-') - 1);
            out = std::min(out, largest_size(s.what, model, bench) / largest_size(first, model, bench));
        }
    }
    return std::max(out, finest_part);
}

/// Takes the errors of one output or equation into a score. nrmse holds the sum of squares until `finish`.
void add(Score& score, std::size_t recording, const std::vector<double>& miss, double size, double floor) {
    std::vector<double> blocks(score_blocks, 0.0);
    double squares = 0;
    for (std::size_t k = 0; k < miss.size(); ++k) {
        blocks[k * score_blocks / miss.size()] += miss[k] * miss[k] * score_blocks / static_cast<double>(miss.size());
        squares += miss[k] * miss[k];
    }
    const double error = std::sqrt(squares / static_cast<double>(miss.size()));
    score.error.push_back(error);
    score.recording.push_back(recording);
    score.rows.push_back(static_cast<double>(miss.size()));
    score.floor.push_back(floor);
    score.blocks.push_back(std::move(blocks));
    score.independent.push_back(static_cast<double>(miss.size()) / rows_that_count_as_one(miss.data(), miss.size()));
    score.nrmse += std::pow(error / std::max(size, 1e-300), 2);
}

void finish(Score& score) { score.nrmse = std::sqrt(score.nrmse / static_cast<double>(std::max<std::size_t>(score.error.size(), 1))); }

/// False, and an error, where a stretch begins before the recording or ends behind it: the part that is there is not what was asked for. The end may be
/// a period behind the last sample: ten seconds of it.
bool within(const Recording& recording, const std::string& option, const std::optional<std::pair<double, double>>& stretch, Diagnostics& diagnostics) {
    const double first = recording.t.front();
    const double last = recording.t.back();
    if (!stretch || (stretch->first >= first - 0.5 * recording.period && stretch->second <= last + 1.5 * recording.period)) return true;
    diagnostics.error(recording.file, {}, fmt::format("{} {:g}:{:g} is not within the recording, which goes from {:.6g} s to {:.6g} s", option, stretch->first, stretch->second, first, last), "a stretch of what was recorded");
    return false;
}

}  // namespace

bool is_kinematic(const model::Model& model, const model::Equation& e) {
    const auto is_rate = [](const formula::Formula& f) { return formula::is_derivative(f) && formula::derivative_order(f) == 1; };
    const auto is_signal = [&](const formula::Formula& f) { return f->kind == formula::Kind::name && model.signal_index(f->name) >= 0; };
    return (is_rate(e.sides.left) && is_signal(e.sides.right)) || (is_signal(e.sides.left) && is_rate(e.sides.right));
}

const Bench& bench_of(const Variant& v, std::size_t recording) { return recording == 0 ? v.bench : v.further[recording - 1]; }

const std::vector<double>& initial_of(const Variant& v, std::size_t recording) { return recording == 0 ? v.fit.initial : v.fit.further_initial[recording - 1]; }

double Score::gap() const {
    double squares = 0;
    for (std::size_t o = 0; o < error.size(); ++o) {
        if (!(floor[o] > 0)) return std::numeric_limits<double>::infinity();
        squares += std::pow(error[o] / floor[o], 2) / static_cast<double>(error.size());
    }
    return std::sqrt(squares);
}

bool Score::white() const {
    for (std::size_t o = 0; o < rows.size(); ++o) if (!(independent[o] > share_of_white * rows[o])) return false;
    return true;
}

std::optional<Parts> parts_of(const Recording& recording, const std::optional<std::pair<double, double>>& train, const std::optional<std::pair<double, double>>& test, Diagnostics& diagnostics) {
    const std::size_t samples = recording.samples();
    const auto row = [&](double t) { return static_cast<std::size_t>(std::lower_bound(recording.t.begin(), recording.t.end(), t - 0.5 * recording.period) - recording.t.begin()); };
    Parts out{};
    out.train = train ? Rows{row(train->first), row(train->second)} : Rows{0, samples * 7 / 10};
    out.test = test ? Rows{row(test->first), std::min(row(test->second) + 1, samples)} : Rows{out.train.end, samples};
    if (train && !test && out.train.end + least_test > samples && out.train.end >= out.train.begin + least_train) {
        diagnostics.error(recording.file, {}, fmt::format("--train {:g}:{:g} leaves {} samples to test on: the recording goes from {:.6g} s to {:.6g} s", train->first, train->second, samples - out.train.end, recording.t.front(), recording.t.back()),
                          fmt::format("train on less, e.g. --train {:g}:{:.3g}; at least {} samples behind it are needed", train->first, recording.t[out.train.begin + (samples - out.train.begin) * 7 / 10], least_test));
        return std::nullopt;
    }
    if (!within(recording, "--train", train, diagnostics) || !within(recording, "--test", test, diagnostics)) return std::nullopt;
    if (out.train.end < out.train.begin + least_train || out.test.end < out.test.begin + least_test) {
        const auto size = [](const Rows& r) { return std::to_string(r.end > r.begin ? r.end - r.begin : 0); };
        diagnostics.error(recording.file, {}, "too short: " + size(out.train) + " samples to train on, " + size(out.test) + " to test on",
                          "at least " + std::to_string(least_train) + " and " + std::to_string(least_test) + " are needed");
        return std::nullopt;
    }
    if (out.test.begin < out.train.end) {
        diagnostics.error(recording.file, {}, "the test stretch starts before the training stretch ends", "test on later data than you train on: --train A:B --test C:D with B <= C");
        return std::nullopt;
    }
    const std::size_t middle = out.train.begin + static_cast<std::size_t>(fit_share * static_cast<double>(out.train.size()));
    out.fitted = {out.train.begin, middle};
    out.validation = {middle, out.train.end};
    return out;
}

int row_intervals(const Rows& rows) {
    int out = intervals_of_a_row;
    while (out > 8 && 2 * rows.size() < least_windows * static_cast<std::size_t>(out)) out /= 2;
    return out;
}

std::optional<Variant> Workbench::prepare(const std::string& text, std::vector<Amendment> amendments, Diagnostics& diagnostics) {
    Diagnostics quiet;
    Diagnostics& said = amendments.empty() ? diagnostics : quiet;
    auto model = model::read_from_text(text, path_, false, said);
    if (!model && !amendments.empty()) {
        const std::vector<Diagnostic> all = quiet.sorted();   // warnings among them
        const auto error = std::find_if(all.begin(), all.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
        unwritten_.emplace(amendments.back().effect, error == all.end() ? "" : error->what);
    }
    if (!model) return std::nullopt;
    if (amendments.empty()) find_idle_kinematics(*model);
    const model::Model whole = *model;
    drop_idle_kinematics(*model);
    std::vector<Bench> benches;
    for (const Trial& trial : trials_) {
        auto one = ready(*model, trial, said);
        if (!one) return std::nullopt;
        one->options.tolerance *= smallest_part(amendments, *model, *one);
        benches.push_back(std::move(*one));
    }
    Variant out{text, std::move(amendments), std::move(*model), whole, std::move(benches[0]), {}, {}};
    out.further.assign(std::make_move_iterator(benches.begin() + 1), std::make_move_iterator(benches.end()));
    return out;
}

std::optional<Bench> Workbench::ready(const model::Model& model, const Trial& trial, Diagnostics& diagnostics) {
    model::Model sampled = model;
    if (trials_.size() > 1) sampled.period = std::nullopt;   // each recording has its own
    auto out = bench(sampled, *trial.recording, diagnostics);
    if (!out) return std::nullopt;
    out->options.tolerance = search_tolerance;
    out->options.effort = &effort_;
    const OdeSystem& system = out->system;
    if (system.driven.empty() && system.laws.empty() && system.delays.empty()) out->options.stride = std::max<std::size_t>(1, trial.parts.train.size() / rows_of_an_undriven_run);
    return out;
}

std::optional<model::Model> Workbench::runnable(const std::string& text) const {
    Diagnostics quiet;
    auto model = model::read_from_text(text, path_, false, quiet);
    if (model) drop_idle_kinematics(*model);
    return model;
}

/// Equations der(x) = v whose x nothing else uses and nothing scores: x is measured, and replayed where an effect needs it.
void Workbench::find_idle_kinematics(const model::Model& model) {
    for (std::size_t e = 0; e < model.equations.size(); ++e) {
        const formula::Formula& left = model.equations[e].sides.left;
        if (!formula::is_derivative(left) || formula::derivative_order(left) != 1) continue;
        const model::Signal& x = *model.signal(left->arguments[0]->name);
        bool used = false;
        for (std::size_t other = 0; other < model.equations.size(); ++other) {
            std::set<std::string> names;
            names_in(model.equations[other].sides.left, names);
            names_in(model.equations[other].sides.right, names);
            used = used || (other != e && names.count(x.name) > 0);
        }
        const bool recorded = std::all_of(trials_.begin(), trials_.end(), [&](const Trial& t) { return t.recording->column(x.column) != nullptr; });
        if (!used && !x.scored && recorded) idle_.insert(model.equations[e].name);
    }
}

void Workbench::drop_idle_kinematics(model::Model& model) const {
    model.equations.erase(std::remove_if(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return idle_.count(e.name) > 0; }), model.equations.end());
}

FitStart Workbench::start_of(const Variant& v, const Variant& from, Rows Parts::*part) const {
    FitStart out{from.fit.parameters, {}, carried_initial(v, from), parts().*part};
    for (std::size_t r = 1; r < recordings(); ++r) out.further.push_back({&v.further[r - 1], carried_initial(v, from, r), parts(r).*part});
    return out;
}

std::vector<BenchRows> Workbench::stretches(const Variant& v, Rows Parts::*part) const {
    std::vector<BenchRows> out;
    for (std::size_t r = 0; r < recordings(); ++r) out.push_back({&bench_of(v, r), parts(r).*part});
    return out;
}

Workbench::OneOfMany::OneOfMany(Workbench& bench) : bench_(bench), limit_(bench.effort_.limit) {
    bench.effort_.limit = std::min(limit_, bench.effort_.spent + share_of_a_candidate * effort_of_a_search);
}

Workbench::OneOfMany::~OneOfMany() {
    bench_.cut_ = bench_.cut_ || bench_.used_up();
    bench_.effort_.limit = limit_;
}

void Workbench::begin_search() {
    effort_.limit = effort_.spent + effort_of_a_search;
    cut_ = false;
}

void Workbench::begin_check() { effort_.limit = effort_.spent + effort_of_a_last_fit; }

Score Workbench::free_run_score(const Variant& v, Rows Parts::*part) const {
    Score out;
    for (std::size_t r = 0; r < recordings(); ++r) {
        const Bench& bench = bench_of(v, r);
        const Rows scored = parts(r).*part;
        const std::size_t begin = parts(r).train.begin;
        const auto run = prediction(bench, v.fit.parameters, initial_of(v, r), {begin, scored.end});
        const std::size_t stride = bench.options.stride;
        const std::size_t skip = (scored.begin - begin + stride - 1) / stride;
        const std::vector<double> noise = noise_by_signal(v.model, bench);
        for (const int s : scored_outputs(v.model, bench)) {
            const std::vector<double>& measured = bench.measured[static_cast<std::size_t>(s)];
            const std::vector<double>& simulated = run[static_cast<std::size_t>(s)];
            const double size = size_of(measured);
            std::vector<double> miss;
            for (std::size_t k = skip; k < simulated.size(); ++k) {
                const double e = measured[begin + k * stride] - simulated[k];
                miss.push_back(std::isfinite(e) ? std::clamp(e, -error_of_divergence * size, error_of_divergence * size) : error_of_divergence * size);
            }
            add(out, r, miss, size, noise[static_cast<std::size_t>(s)]);
        }
    }
    finish(out);
    return out;
}

Score Workbench::rows_score(const Variant& v, Rows Parts::*part) const {
    Score out;
    for (std::size_t r = 0; r < recordings(); ++r) {
        const Bench& bench = bench_of(v, r);
        const Rows rows = parts(r).*part;
        const int intervals = row_intervals(parts(r).validation);
        const std::vector<double> noise = noise_by_signal(v.model, bench);
        for (std::size_t e = 0; e < v.model.equations.size(); ++e) {
            if (is_kinematic(v.model, v.model.equations[e])) continue;   // a definition; every variant scores the same equations
            const auto form = weak_form(v.model, bench, e, rows, intervals);
            if (!form) continue;
            // In units of the driving side: an effect that makes that smaller makes the residual smaller, and explains nothing by it.
            const double size = driving_size(*form, v.fit.parameters);
            const Eigen::VectorXd residual = weak_residual(*form, v.fit.parameters) / size;
            add(out, r, {residual.data(), residual.data() + residual.size()}, 1, weak_noise(v.model, bench, e, rows, intervals, v.fit.parameters, noise) / size);
        }
    }
    finish(out);
    return out;
}

FreeRun Workbench::run(const Variant& v, double tolerance, std::size_t recording) const {
    const Bench& bench = bench_of(v, recording);
    const Rows train = parts(recording).train;
    RunOptions options = bench.options;
    options.tolerance = tolerance;
    options.first = train.begin;
    options.stride = 1;
    FreeRun out = free_run(bench.system, v.fit.parameters, initial_of(v, recording), bench.drive, options);
    if (train.begin == 0) return out;
    // The rows before the training stretch: from the recording's own start, which nothing was fitted to.
    options.first = 0;
    options.end = train.begin;
    FreeRun before = free_run(bench.system, v.fit.parameters, bench.initial, bench.drive, options);
    for (std::size_t s = 0; s < out.signals.size(); ++s) {
        if (out.signals[s].empty()) continue;
        before.signals[s].resize(train.begin, before.signals[s].back());
        out.signals[s].insert(out.signals[s].begin(), before.signals[s].begin(), before.signals[s].end());
    }
    out.samples += train.begin;
    return out;
}

bool Workbench::drifts(const Variant& fitted) const {
    for (std::size_t r = 0; r < recordings(); ++r) if (drifts(fitted, r)) return true;
    return false;
}

bool Workbench::drifts(const Variant& fitted, std::size_t recording) const {
    const Bench& bench = bench_of(fitted, recording);
    const Rows train = parts(recording).train;
    const Rows rows = {train.begin, train.begin + train.size() / 3};
    constexpr double push = 0.01;   // of a state's size: far above the tolerance of a run, and what is not proportional to it is 1 percent
    const std::vector<double>& start = initial_of(fitted, recording);
    std::vector<double> pushed = start;
    for (std::size_t i = 0; i < pushed.size(); ++i) pushed[i] += push * bench.options.scale[i];
    const auto here = prediction(bench, fitted.fit.parameters, start, rows);
    const auto there = prediction(bench, fitted.fit.parameters, pushed, rows);
    const std::vector<StateEntry>& states = bench.system.states;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::size_t s = static_cast<std::size_t>(states[i].signal);
        if (states[i].order > 0 || bench.measured[s].empty() || !fitted.model.signals[s].scored) continue;
        const std::size_t count = here[s].size();
        const std::size_t from = count - count / 5;
        double squares = 0;
        for (std::size_t row = from; row < count; ++row) squares += std::pow(there[s][row] - here[s][row], 2);
        const double left = std::sqrt(squares / static_cast<double>(count - from)) / (push * bench.options.scale[i]);
        if (!(left < lasting)) return true;   // NaN: it diverged
    }
    return false;
}

std::size_t equation_index(const model::Model& model, const std::string& name) {
    for (std::size_t e = 0; e < model.equations.size(); ++e) if (model.equations[e].name == name) return e;
    return 0;
}

void carry_past(Variant& v, const Variant& from) {
    v.bench.drive.from_rest = from.bench.drive.from_rest;
    for (std::size_t r = 0; r < v.further.size(); ++r) v.further[r].drive.from_rest = from.further[r].drive.from_rest;
}

std::vector<double> carried_initial(const Variant& v, const Variant& from, std::size_t recording) {
    std::vector<double> out = bench_of(v, recording).initial;
    const std::vector<StateEntry>& states = from.bench.system.states;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const StateEntry& own = v.bench.system.states[i];
        for (std::size_t k = 0; k < states.size(); ++k) {
            const bool same = states[k].order == own.order && from.model.signals[static_cast<std::size_t>(states[k].signal)].name == v.model.signals[static_cast<std::size_t>(own.signal)].name;
            if (same) out[i] = initial_of(from, recording)[k];
        }
    }
    return out;
}

namespace {

double gain_of(const Score& a, const Score& b, std::size_t o) {
    return log_gain(std::min(a.independent[o], b.independent[o]), a.error[o], b.error[o]);
}

}  // namespace

double log_gain(const Score& a, const Score& b) {
    double out = 0;
    for (std::size_t o = 0; o < a.error.size(); ++o) out += gain_of(a, b, o);
    return out;
}

double log_gain(const Score& a, const Score& b, std::size_t recording) {
    double out = 0;
    for (std::size_t o = 0; o < a.error.size(); ++o) if (a.recording[o] == recording) out += gain_of(a, b, o);
    return out;
}

double significance(const Score& a, const Score& b) {
    double mean = 0;
    std::vector<double> gain(score_blocks, 0.0);
    for (std::size_t k = 0; k < score_blocks; ++k) {
        for (std::size_t o = 0; o < a.error.size(); ++o) {
            const double tiny = 1e-12 * (a.error[o] * a.error[o] + b.error[o] * b.error[o]) + 1e-300;
            gain[k] += std::log((b.blocks[o][k] + tiny) / (a.blocks[o][k] + tiny));
        }
        mean += gain[k] / static_cast<double>(score_blocks);
    }
    double squares = 0;
    for (const double g : gain) squares += (g - mean) * (g - mean);
    const double count = static_cast<double>(score_blocks);
    const double error = std::sqrt(squares / (count * (count - 1)));
    return error > 0 ? mean / error : 0;
}

}  // namespace algest::lab
