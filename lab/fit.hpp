// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters from the free run's output error: a bounded Levenberg-Marquardt (Ceres) over parameters and initial values.
#pragma once
#include <cstddef>
#include <vector>

#include "lab/short_runs.hpp"

namespace algest::lab {

/// What a fit starts from and looks at.
struct FitStart {
    std::vector<double> parameters;   ///< by the model's parameters
    std::vector<bool> fixed;          ///< by parameter; empty: none
    std::vector<double> initial;      ///< by state entry
    Rows rows;                        ///< scored; the run starts at rows.begin
    std::size_t horizon = 0;          ///< samples of a run (short_runs.hpp); above 0, no initial value is fitted
    int most_iterations = 25;
    double tolerance = 1e-7;          ///< relative change of the cost at which it stops
};

/// What came of it.
struct Fit {
    std::vector<double> parameters;
    std::vector<double> sd;           ///< by parameter, its unit; infinite where the data do not see it
    std::vector<double> initial;      ///< by state entry, at rows.begin
    double cost;                      ///< mean over outputs of nrmse^2 over the rows
    bool converged;
    int runs;                         ///< free runs it took
};

/// The moving signals that a fit compares: measured and scored, in the order of the system.
std::vector<int> scored_outputs(const model::Model& model, const Bench& bench);

/// How many rows of a residual count as one: the sum of its autocorrelation up to its first zero, both sides.
double rows_that_count_as_one(const double* residual, std::size_t rows);

/// Mean over outputs of the squared error over (size of the measured signal)^2.
double output_error(const model::Model& model, const Bench& bench, const FitStart& at);

/// Minimises the sum over outputs of the squared error over (size of the measured signal)^2. Parameters stay within the model's
/// min and max. A run that diverges counts as an error of 1e3 sizes from there on.
/// Standard deviations are those of the linearised fit, enlarged by the autocorrelation of the residuals.
/// Cost: (free parameters + fitted initial values + 1) runs an iteration.
Fit fit(const model::Model& model, const Bench& bench, const FitStart& start);

}  // namespace algest::lab
