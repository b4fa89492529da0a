// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/simulate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/csv_text.hpp"
#include "lab/noise.hpp"

namespace algest::lab {

namespace {

/// Samples that the initial derivative of a measured signal is taken from.
constexpr std::size_t initial_samples = 25;

/// Value and derivatives at the first sample of a parabola through the first samples, by least squares.
Eigen::Vector3d initial_parabola(const std::vector<double>& x, double period) {
    const Eigen::Index count = static_cast<Eigen::Index>(std::min(x.size(), initial_samples));
    Eigen::MatrixXd basis(count, 3);
    Eigen::VectorXd values(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const double t = static_cast<double>(k) * period;
        basis.row(k) << 1.0, t, 0.5 * t * t;
        values[k] = x[static_cast<std::size_t>(k)];
    }
    return basis.colPivHouseholderQr().solve(values);
}

double initial_value(const model::Signal& signal, const std::vector<double>& measured, int order, double period) {
    if (signal.initial) return order == 0 ? exact::nearest(*signal.initial, plan::Scalar::float64) : 0.0;
    if (measured.empty()) return 0.0;
    if (order == 0) return measured[0];
    return order <= 2 ? initial_parabola(measured, period)[order] : 0.0;
}

constexpr double largest_excursion = 1e6;   ///< of a state's size: a run beyond it has diverged

/// The largest value measured; of a hidden state, the largest declared: initial, min or max. 0 where nothing says.
double known_size(const model::Signal& signal, const std::vector<double>& measured) {
    double largest = 0;
    for (const double x : measured) largest = std::max(largest, std::abs(x));
    if (!measured.empty()) return largest;
    for (const auto& declared : {signal.initial, signal.min, signal.max}) {
        if (declared) largest = std::max(largest, exact::nearest(cln::abs(*declared), plan::Scalar::float64));
    }
    return largest;
}

constexpr double of_noise = 3.0;   ///< standard deviations that a signal at zero hardly shows

/// True when what is measured of the machine's states is zero at the first sample and at the next: no input has driven it yet.
bool starts_at_rest(const model::Model& model, const Bench& bench) {
    const std::vector<double> noise = noise_by_signal(model, bench);
    bool seen = false;
    for (const StateEntry& entry : bench.system.states) {
        const std::size_t s = static_cast<std::size_t>(entry.signal);
        if (entry.order > 0 || bench.measured[s].empty()) continue;
        seen = true;
        for (std::size_t row = 0; row < std::min<std::size_t>(2, bench.measured[s].size()); ++row) if (std::abs(bench.measured[s][row]) > of_noise * noise[s]) return false;
    }
    return seen;
}

}  // namespace

double size_of(const std::vector<double>& measured) {
    double sum = 0;
    double squares = 0;
    for (const double x : measured) {
        sum += x;
        squares += x * x;
    }
    const double count = static_cast<double>(measured.size());
    const double mean = sum / count;
    double spread = 0;
    for (const double x : measured) spread += (x - mean) * (x - mean);
    return std::max(std::sqrt(spread / count), 0.1 * std::sqrt(squares / count));
}

std::optional<Bench> bench(const model::Model& model, const Recording& recording, Diagnostics& diagnostics) {
    auto system = ode_system(model, diagnostics);
    if (!system) return std::nullopt;
    Bench out;
    out.drive.period = model.period ? exact::nearest(*model.period, plan::Scalar::float64) : recording.period;
    if (!check_period(recording, model.name, out.drive.period, diagnostics)) return std::nullopt;
    out.drive.samples = recording.samples();
    out.drive.values.resize(model.signals.size());
    out.measured.resize(model.signals.size());
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const model::Signal& signal = model.signals[s];
        out.drive.held.push_back(signal.hold == plan::Hold::zoh);
        const bool drives = std::find(system->driven.begin(), system->driven.end(), static_cast<int>(s)) != system->driven.end();
        if (!drives && recording.column(signal.column) == nullptr) {   // a hidden state, or a signal that nothing uses
            if (signal.noise || signal.resolution || signal.column != signal.name) {
                diagnostics.error(model.path, signal.at, "'" + signal.name + "' is declared as measured, but the recording has no column '" + signal.column + "'; there are " + recording.column_names(),
                                  "give it column = \"...\", or leave out noise, resolution and column if nothing measures it");
            }
            continue;
        }
        auto values = signal_values(recording, {signal.name, signal.column, signal.unit}, diagnostics);
        if (!values) continue;
        if (drives) out.drive.values[s] = *values;
        out.measured[s] = std::move(*values);
    }
    if (diagnostics.has_errors()) return std::nullopt;
    for (const StateEntry& entry : system->states) {
        const model::Signal& signal = model.signals[static_cast<std::size_t>(entry.signal)];
        const std::vector<double>& measured = out.measured[static_cast<std::size_t>(entry.signal)];
        if (measured.empty() && !signal.initial && entry.order == 0) diagnostics.note(model.path, "the hidden state '" + signal.name + "' starts at 0");
        out.initial.push_back(initial_value(signal, measured, entry.order, out.drive.period));
        const double known = known_size(signal, measured);
        // A derivative changes by the signal's size within some tens of periods at the fastest.
        out.options.scale.push_back((known > 0 ? known : 1.0) * std::pow(0.03 / out.drive.period, entry.order));
        // A hidden state of which nothing is known may go as far as numbers do: in Pa a sound run passes 1e6 at once.
        const bool bounded = known > 0 || !measured.empty();
        out.options.farthest.push_back(bounded ? largest_excursion * out.options.scale.back() : std::numeric_limits<double>::max());
    }
    out.system = std::move(*system);
    out.drive.from_rest = !out.system.delays.empty() && starts_at_rest(model, out);
    return out;
}

std::optional<std::vector<double>> parameter_values(const model::Model& model, const std::map<std::string, double>& set, Diagnostics& diagnostics) {
    std::vector<double> out;
    for (const model::Parameter& p : model.parameters) {
        const auto given = set.find(p.name);
        if (given == set.end() && !p.initial) {
            diagnostics.error(model.path, p.at, "parameter '" + p.name + "' has no initial value", "add initial = ..., or give --set " + p.name + "=VALUE");
            continue;
        }
        out.push_back(given != set.end() ? given->second : exact::nearest(*p.initial, plan::Scalar::float64));
    }
    for (const auto& [name, value] : set) {
        if (model.parameter(name) != nullptr) continue;
        std::string all;
        for (const model::Parameter& p : model.parameters) all += (all.empty() ? "" : ", ") + p.name;
        diagnostics.error(model.path, {}, "--set names '" + name + "', which is no parameter", "parameters are " + all);
    }
    if (diagnostics.has_errors()) return std::nullopt;
    return out;
}

std::vector<OutputError> output_errors(const model::Model& model, const Bench& bench, const FreeRun& run, std::size_t begin, std::size_t end) {
    std::vector<OutputError> out;
    for (const int s : simulated_signals(bench.system)) {
        const std::size_t k = static_cast<std::size_t>(s);
        if (bench.measured[k].empty() || !model.signals[k].scored) continue;
        double squares = 0;
        for (std::size_t row = begin; row < end; ++row) {
            const double miss = bench.measured[k][row] - run.signals[k][row];
            squares += miss * miss;
        }
        const double rmse = std::sqrt(squares / static_cast<double>(end - begin));
        out.push_back({s, rmse, rmse / size_of(bench.measured[k])});
    }
    return out;
}

std::string run_csv(const model::Model& model, const Recording& recording, const FreeRun& run) {
    std::string out = "t [s]";
    for (std::size_t s = 0; s < run.signals.size(); ++s) {
        if (!run.signals[s].empty()) out += "," + csv_heading(model.signals[s].name, model.signals[s].unit);
    }
    out += "\n";
    for (std::size_t row = 0; row < run.samples; ++row) {
        append_number<double>(out, recording.t[row]);
        for (const std::vector<double>& values : run.signals) {
            if (values.empty()) continue;
            out += ",";
            append_number<double>(out, values[row]);
        }
        out += "\n";
    }
    return out;
}

}  // namespace algest::lab
