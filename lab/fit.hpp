// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters from the free run's output error: a bounded Levenberg-Marquardt (Ceres) over parameters and initial values.
#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "lab/simulate.hpp"

namespace algest::lab {

/// Rows [begin, end) of a recording.
struct Rows {
    std::size_t begin;
    std::size_t end;
    std::size_t size() const { return end - begin; }
};

/// Error, in sizes of the measured signal, that counts for a run that has diverged, and the most that counts at all.
constexpr double error_of_divergence = 1e3;

/// A stretch of another recording of the same machine: the same parameters, an initial state of its own.
struct FurtherRun {
    const Bench* bench;               ///< of the same model; outlives the fit
    std::vector<double> initial;      ///< by state entry
    Rows rows;
};

/// What a fit starts from and looks at.
struct FitStart {
    std::vector<double> parameters;   ///< by the model's parameters
    std::vector<bool> fixed;          ///< by parameter; empty: none
    std::vector<double> initial;      ///< by state entry
    Rows rows;                        ///< scored; the run starts at rows.begin
    int most_iterations = 25;
    double tolerance = 1e-7;          ///< relative change of the cost at which it stops
    std::vector<FurtherRun> further = {};
};

/// What came of it.
struct Fit {
    std::vector<double> parameters;
    std::vector<double> sd;           ///< by parameter, its unit; infinite where the data do not see it
    std::vector<double> initial;      ///< by state entry, at rows.begin
    double cost;                      ///< mean over outputs of nrmse^2 over the rows
    bool converged;
    int runs;                         ///< free runs it took
    std::vector<std::vector<double>> further_initial = {};   ///< by further run
    std::vector<double> squares = {};       ///< squared error by scored output of each run, in shares of its size
    std::vector<double> independent = {};   ///< rows that count as independent, the same
    std::size_t begin = 0;                  ///< row of the fit's own run at which it starts
    std::vector<double> initial_sd = {};    ///< by state entry of the fit's own run; as sd
};

/// Twice the gain in log-likelihood of an error over another one on rows of which so many are independent; 0 where one of them is none.
double log_gain(double independent, double error, double other);

/// Twice the gain in log-likelihood of fit a over fit b on the rows that both were fitted to; 0 where they compare other outputs.
double log_gain(const Fit& a, const Fit& b);

/// The simulated signals that a fit compares: measured and scored, in the order of the model: the same for all variants of one.
std::vector<int> scored_outputs(const model::Model& model, const Bench& bench);

/// The run over the rows from an initial state, every `stride` of the bench, by the model's signals; NaN from where it diverged on.
std::vector<std::vector<double>> prediction(const Bench& bench, const std::vector<double>& parameters, const std::vector<double>& initial, Rows rows);

/// How many rows of a residual count as one: the sum of its autocorrelation up to its first zero, both sides.
double rows_that_count_as_one(const double* residual, std::size_t rows);

/// Mean over outputs of the squared error over (size of the measured signal)^2.
double output_error(const model::Model& model, const Bench& bench, const FitStart& at);

/// The error of every scored output at every row, each over (size of its signal * sqrt(rows)): squares sum to the sum of nrmse^2. With
/// further runs the sizes are the largest of all recordings and the rows are all their rows; they follow one another.
std::vector<double> output_residual(const model::Model& model, const Bench& bench, const FitStart& at);

/// Its slope by what a fit at this start would move, a column each, in units of the start's own size of it.
Eigen::MatrixXd output_slopes(const model::Model& model, const Bench& bench, const FitStart& at);

/// Minimises the sum over outputs of the squared error over (size of the measured signal)^2. Parameters stay within the model's
/// min and max. A run that diverges counts as an error of 1e3 sizes from there on.
/// Standard deviations are those of the linearised fit, enlarged by the autocorrelation of the residuals.
/// Cost: (free parameters + fitted initial values + 1) runs an iteration; it ends early once the bench's effort is used up.
Fit fit(const model::Model& model, const Bench& bench, const FitStart& start);

}  // namespace algest::lab
