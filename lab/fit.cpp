// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/fit.hpp"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lab/deviations.hpp"

namespace algest::lab {

namespace {

constexpr double digits_of_a_slope = 1e-3;   ///< slopes are differences of runs

/// An initial value that the optimiser moves: of which run, and which state entry.
struct StartEntry {
    std::size_t run;
    std::size_t entry;
};

/// What the optimiser moves: scaled free parameters, then scaled initial values.
struct Variables {
    std::vector<std::size_t> parameters;
    std::vector<StartEntry> entries;
    std::vector<double> scale;   ///< of both in turn
    std::size_t size() const { return parameters.size() + entries.size(); }
};

/// The fit's own run, then the further ones.
std::vector<FurtherRun> all_runs(const Bench& bench, const FitStart& start) {
    std::vector<FurtherRun> out = {{&bench, start.initial, start.rows}};
    out.insert(out.end(), start.further.begin(), start.further.end());
    return out;
}

std::size_t kept_rows(const FurtherRun& run) { return (run.rows.size() + run.bench->options.stride - 1) / run.bench->options.stride; }

class FreeRunError : public ceres::CostFunction {
public:
    FreeRunError(const model::Model& model, const Bench& bench, const FitStart& start, Variables variables)
        : runs_(all_runs(bench, start)), parameters_(start.parameters), variables_(std::move(variables)) {
        for (const FurtherRun& run : runs_) {
            for (const int s : scored_outputs(model, *run.bench)) {
                blocks_.push_back({static_cast<std::size_t>(&run - runs_.data()), static_cast<std::size_t>(s), kept_rows(run)});
                double& size = sizes_[s];
                size = std::max(size, size_of(run.bench->measured[static_cast<std::size_t>(s)]));
            }
            rows_ += kept_rows(run);
        }
        std::size_t residuals = 0;
        for (const Block& block : blocks_) residuals += block.rows;
        set_num_residuals(static_cast<int>(residuals));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(variables_.size()));
    }

    /// One output of one run; the residuals are block by block.
    struct Block {
        std::size_t run;
        std::size_t signal;
        std::size_t rows;
    };

    /// Residuals in units of size / sqrt(rows): their squares sum to the sum of nrmse^2.
    void residuals(const double* x, double* out) const {
        std::vector<double> parameters = parameters_;
        std::vector<std::vector<double>> initial;
        for (const FurtherRun& run : runs_) initial.push_back(run.initial);
        spread(x, parameters, initial);
        const double scale = 1.0 / std::sqrt(static_cast<double>(rows_));
        std::vector<std::vector<std::vector<double>>> simulated;
        for (std::size_t r = 0; r < runs_.size(); ++r) simulated.push_back(prediction(*runs_[r].bench, parameters, initial[r], runs_[r].rows));
        runs += static_cast<int>(runs_.size());
        for (const Block& block : blocks_) {
            const FurtherRun& run = runs_[block.run];
            const double size = sizes_.at(static_cast<int>(block.signal));
            for (std::size_t row = 0; row < block.rows; ++row) {
                const double miss = (run.bench->measured[block.signal][run.rows.begin + row * run.bench->options.stride] - simulated[block.run][block.signal][row]) / size;
                *out++ = scale * (std::isfinite(miss) ? std::clamp(miss, -error_of_divergence, error_of_divergence) : error_of_divergence);
            }
        }
    }

    bool Evaluate(double const* const* x, double* out, double** jacobians) const override {
        residuals(x[0], out);
        if (jacobians == nullptr || jacobians[0] == nullptr) return true;
        const std::size_t columns = variables_.size();
        const std::size_t rows = static_cast<std::size_t>(num_residuals());
        std::vector<double> moved(x[0], x[0] + columns);
        std::vector<double> ahead(rows);
        for (std::size_t c = 0; c < columns; ++c) {
            const double step = 1e-4 * std::max(std::abs(x[0][c]), 1e-2);   // far above what the run's tolerance blurs
            moved[c] = x[0][c] + step;
            residuals(moved.data(), ahead.data());
            moved[c] = x[0][c];
            for (std::size_t r = 0; r < rows; ++r) jacobians[0][r * columns + c] = (ahead[r] - out[r]) / step;
        }
        return true;
    }

    /// initial: by run.
    void spread(const double* x, std::vector<double>& parameters, std::vector<std::vector<double>>& initial) const {
        std::size_t k = 0;
        for (const std::size_t p : variables_.parameters) { parameters[p] = x[k] * variables_.scale[k]; ++k; }
        for (const StartEntry& e : variables_.entries) { initial[e.run][e.entry] = x[k] * variables_.scale[k]; ++k; }
    }

    const std::vector<Block>& blocks() const { return blocks_; }
    mutable int runs = 0;

private:
    std::vector<FurtherRun> runs_;
    std::vector<double> parameters_;
    Variables variables_;
    std::vector<Block> blocks_;
    std::map<int, double> sizes_;   ///< by signal: the largest of all recordings
    std::size_t rows_ = 0;          ///< rows that are compared, of all runs
};

/// Ends a fit, with the best it has, once the effort that it shares is used up.
class StopWhenUsedUp : public ceres::IterationCallback {
public:
    explicit StopWhenUsedUp(const Effort* effort) : effort_(effort) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
        return effort_ != nullptr && effort_->used_up() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

private:
    const Effort* effort_;
};

Variables choose_variables(const model::Model& model, const Bench& bench, const FitStart& start) {
    Variables out;
    for (std::size_t p = 0; p < model.parameters.size(); ++p) {
        if (!start.fixed.empty() && start.fixed[p]) continue;
        out.parameters.push_back(p);
        const double range = model.parameters[p].max ? 1e-3 * exact::nearest(cln::abs(*model.parameters[p].max), plan::Scalar::float64) : 1e-3;
        out.scale.push_back(start.parameters[p] != 0 ? std::abs(start.parameters[p]) : range);
    }
    const std::vector<FurtherRun> runs = all_runs(bench, start);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        for (std::size_t e = 0; e < runs[r].bench->system.states.size(); ++e) {
            out.entries.push_back({r, e});
            out.scale.push_back(runs[r].bench->options.scale[e]);
        }
    }
    return out;
}

std::vector<double> scaled_start(const Bench& bench, const FitStart& start, const Variables& variables) {
    const std::vector<FurtherRun> runs = all_runs(bench, start);
    std::vector<double> x;
    for (const std::size_t p : variables.parameters) x.push_back(start.parameters[p]);
    for (const StartEntry& e : variables.entries) x.push_back(runs[e.run].initial[e.entry]);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] /= variables.scale[k];
    return x;
}

}  // namespace

std::vector<int> scored_outputs(const model::Model& model, const Bench& bench) {
    std::vector<int> out;
    for (const int s : simulated_signals(bench.system)) {
        if (!bench.measured[static_cast<std::size_t>(s)].empty() && model.signals[static_cast<std::size_t>(s)].scored) out.push_back(s);
    }
    std::sort(out.begin(), out.end());   // a sensor's fault makes an output of what was a state: it stays in its place
    return out;
}

std::vector<std::vector<double>> prediction(const Bench& bench, const std::vector<double>& parameters, const std::vector<double>& initial, Rows rows) {
    RunOptions options = bench.options;
    options.first = rows.begin;
    options.end = rows.end;
    FreeRun run = free_run(bench.system, parameters, initial, bench.drive, options);
    const std::size_t count = (rows.size() + options.stride - 1) / options.stride;
    for (std::vector<double>& signal : run.signals) if (!signal.empty()) signal.resize(count, std::numeric_limits<double>::quiet_NaN());
    return std::move(run.signals);
}

double rows_that_count_as_one(const double* r, std::size_t count) {
    double power = 0;
    for (std::size_t k = 0; k < count; ++k) power += r[k] * r[k];
    if (!(power > 0)) return 1;
    double sum = 1;
    const std::size_t longest = std::min<std::size_t>(count / 4, 4000);
    for (std::size_t lag = 1; lag < longest; ++lag) {
        double product = 0;
        for (std::size_t k = lag; k < count; ++k) product += r[k] * r[k - lag];
        if (product <= 0) break;
        sum += 2 * product / power;
    }
    return sum;
}

std::vector<double> output_residual(const model::Model& model, const Bench& bench, const FitStart& at) {
    const FreeRunError error(model, bench, at, {});
    std::vector<double> out(static_cast<std::size_t>(error.num_residuals()));
    error.residuals(nullptr, out.data());
    return out;
}

double output_error(const model::Model& model, const Bench& bench, const FitStart& at) {
    double squares = 0;
    for (const double r : output_residual(model, bench, at)) squares += r * r;
    return squares / static_cast<double>(scored_outputs(model, bench).size());
}

Eigen::MatrixXd output_slopes(const model::Model& model, const Bench& bench, const FitStart& at) {
    const Variables variables = choose_variables(model, bench, at);
    const FreeRunError error(model, bench, at, variables);
    const std::vector<double> x = scaled_start(bench, at, variables);
    std::vector<double> residual(static_cast<std::size_t>(error.num_residuals()));
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> slopes(error.num_residuals(), static_cast<Eigen::Index>(variables.size()));
    const double* block = x.data();
    double* columns = slopes.data();
    error.Evaluate(&block, residual.data(), &columns);
    return slopes;
}

double log_gain(double independent, double error, double other) { return error > 0 && other > 0 ? independent * 2 * std::log(other / error) : 0; }

double log_gain(const Fit& a, const Fit& b) {
    if (a.squares.size() != b.squares.size()) return 0;
    double out = 0;
    for (std::size_t o = 0; o < a.squares.size(); ++o) out += log_gain(std::min(a.independent[o], b.independent[o]), std::sqrt(a.squares[o]), std::sqrt(b.squares[o]));
    return out;
}

Fit fit(const model::Model& model, const Bench& bench, const FitStart& start) {
    const Variables variables = choose_variables(model, bench, start);
    std::vector<double> x = scaled_start(bench, start, variables);
    std::vector<std::vector<double>> initial;
    for (const FurtherRun& run : all_runs(bench, start)) initial.push_back(run.initial);
    auto* cost = new FreeRunError(model, bench, start, variables);   // the problem owns it
    ceres::Problem problem;
    problem.AddResidualBlock(cost, nullptr, x.data());
    for (std::size_t k = 0; k < variables.parameters.size(); ++k) {
        const model::Parameter& p = model.parameters[variables.parameters[k]];
        const double low = p.min ? exact::nearest(*p.min, plan::Scalar::float64) / variables.scale[k] : -std::numeric_limits<double>::infinity();
        const double high = p.max ? exact::nearest(*p.max, plan::Scalar::float64) / variables.scale[k] : std::numeric_limits<double>::infinity();
        x[k] = std::clamp(x[k], low, high);   // a start that the bounds forbid stops the optimiser
        if (p.min) problem.SetParameterLowerBound(x.data(), static_cast<int>(k), low);
        if (p.max) problem.SetParameterUpperBound(x.data(), static_cast<int>(k), high);
    }
    ceres::Solver::Options options;
    options.max_num_iterations = start.most_iterations;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = start.tolerance;
    options.parameter_tolerance = start.tolerance;
    options.num_threads = 1;
    StopWhenUsedUp stop(bench.options.effort);
    options.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    Fit out{start.parameters, std::vector<double>(start.parameters.size(), std::numeric_limits<double>::infinity()), {}, 0, summary.termination_type == ceres::CONVERGENCE, 0};
    cost->spread(x.data(), out.parameters, initial);
    out.initial = initial[0];
    out.further_initial.assign(initial.begin() + 1, initial.end());
    const std::size_t count = static_cast<std::size_t>(cost->num_residuals());
    std::vector<double> residuals(count);
    std::vector<double> jacobian(count * variables.size());
    const double* block = x.data();
    double* columns = jacobian.data();
    cost->Evaluate(&block, residuals.data(), &columns);
    // Each output has its own noise: rows are divided by it before the normal equations.
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(variables.size()), static_cast<Eigen::Index>(variables.size()));
    const double outputs = static_cast<double>(scored_outputs(model, bench).size());
    std::size_t at = 0;
    for (const FreeRunError::Block& of : cost->blocks()) {
        const double* r = residuals.data() + at;
        double squares = 0;
        for (std::size_t k = 0; k < of.rows; ++k) squares += r[k] * r[k];
        out.cost += squares / outputs;
        const double as_one = rows_that_count_as_one(r, of.rows);
        out.squares.push_back(squares);
        out.independent.push_back(static_cast<double>(of.rows) / as_one);
        const double variance = squares / static_cast<double>(of.rows) * as_one;
        const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> part(jacobian.data() + at * variables.size(), static_cast<Eigen::Index>(of.rows), static_cast<Eigen::Index>(variables.size()));
        if (variance > 0) normal += part.transpose() * part / variance;
        at += of.rows;
    }
    const Eigen::VectorXd deviations = deviations_of(normal, digits_of_a_slope);
    for (std::size_t k = 0; k < variables.parameters.size(); ++k) out.sd[variables.parameters[k]] = deviations[static_cast<Eigen::Index>(k)] * variables.scale[k];
    out.begin = start.rows.begin;
    for (std::size_t e = 0; e < out.initial.size(); ++e) {   // the entries of the own run come first
        const std::size_t k = variables.parameters.size() + e;
        out.initial_sd.push_back(deviations[static_cast<Eigen::Index>(k)] * variables.scale[k]);
    }
    out.runs = cost->runs;
    return out;
}

}  // namespace algest::lab
