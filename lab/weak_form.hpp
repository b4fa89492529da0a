// SPDX-License-Identifier: GPL-3.0-or-later
// One equation in its weak form on a recording: a row per window, a column per term, by the annihilator's kernels.
#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "generator/equation.hpp"
#include "lab/fit.hpp"

namespace algest::lab {

/// Rows of  sum coefficient_k(theta) K[product_k] = 0  (p = 1), one every half window.
struct WeakForm {
    Eigen::MatrixXd columns;                  ///< windows x terms, T^-order included
    std::vector<Polynomial> coefficients;     ///< by term, in the model's parameters
    std::vector<bool> used;                   ///< by parameter of the model: it stands in this equation
    std::vector<bool> leading;                ///< by parameter: it stands in the leading coefficient
    int first_leading;                        ///< term of the leading derivative; -1: none
    bool driven;                              ///< some term has a known coefficient
    std::vector<bool> of_input;               ///< by term: a signal that no equation moves stands in it
    std::vector<std::size_t> centre;          ///< by window: the sample in its middle
    std::size_t left_out = 0;                 ///< windows in which a product is no finite number: rows of zeros, which say nothing
};

/// Window lengths, in intervals, that are worth trying on so many rows: noise wants long windows, fast dynamics short ones.
std::vector<int> weak_intervals(const Rows& rows);

/// True when rows of an equation can be formed: it moves something, every signal of it is measured, and no parameter enters nonlinearly.
bool has_weak_form(const model::Model& model, const Bench& bench, std::size_t equation);

/// Weights, oldest sample first, that the rows of an equation give to what is not differentiated, held linearly.
std::vector<double> row_weights(const model::Model& model, std::size_t equation, int intervals);

/// Nullopt where has_weak_form is false, or the rows are fewer than two windows. intervals: of a window.
std::optional<WeakForm> weak_form(const model::Model& model, const Bench& bench, std::size_t equation, Rows rows, int intervals);

/// A stretch of a recording.
struct BenchRows {
    const Bench* bench;
    Rows rows;
};

/// The rows of several recordings of one machine, one below the other, as one form; recordings that have none are left out, and so is
/// `centre`. intervals: of a window, in samples of each recording.
std::optional<WeakForm> weak_form(const model::Model& model, const std::vector<BenchRows>& stretches, std::size_t equation, int intervals);

/// Least squares of the rows over the parameters of the equation, from `start` on (one Gauss-Newton step is exact where the equation is
/// linear). Parameters of the leading coefficient are held where no term is known.
struct WeakFit {
    std::vector<double> parameters;
    double residual;                          ///< sum of squares
    int windows;
    int unknowns;
};
WeakFit weak_fit(const WeakForm& form, const std::vector<double>& start);

/// F statistic of the unknowns that `after` has beyond `before`, of the same rows: about 1 where they are noise.
double f_statistic(const WeakFit& before, const WeakFit& after);

/// Parameters with standard deviations; infinite for those that no row sees.
struct WeakEstimate {
    std::vector<double> parameters;
    std::vector<double> sd;
};

/// The same over all equations and stretches at once, each in units of its own residual: what free runs start from. Within the model's bounds;
/// parameters that no measured equation sees stay at `start`. Standard deviations count autocorrelated windows as less than one.
WeakEstimate weak_estimate(const model::Model& model, const std::vector<BenchRows>& stretches, int intervals, const std::vector<double>& start);

/// Rms over the windows of the driving side: the terms with known coefficients, else the leading one. Of a residual, the measure that
/// R^2 = 1 - (rms residual / rms driving side)^2 is taken by.
double driving_size(const WeakForm& form, const std::vector<double>& parameters);

/// Rms over the windows of the terms with inputs in them; 0: there are none.
double input_size(const WeakForm& form, const std::vector<double>& parameters);

/// Standard deviation of a window's residual that white sensor noise makes, rms over the windows; 0 where the equation is not measured.
/// noise: by signal, in its unit. A switch in a regressor counts as if it did not move.
double weak_noise(const model::Model& model, const Bench& bench, std::size_t equation, Rows rows, int intervals, const std::vector<double>& parameters, const std::vector<double>& noise);

/// Residual of every window.
Eigen::VectorXd weak_residual(const WeakForm& form, const std::vector<double>& parameters);

}  // namespace algest::lab
