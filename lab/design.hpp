// SPDX-License-Identifier: GPL-3.0-or-later
// Which window, rows, kappa and engine suit a recording: every choice is tried on it, and the curve of noise against perturbation shown.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/model.hpp"
#include "lab/engine_choice.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// One estimator, run over the whole recording. By parameter: over the `ok` samples of its second half.
struct Trial {
    double window_s;
    std::vector<int> kappa;               ///< by equation of the model
    std::vector<std::vector<int>> rows;   ///< by equation: the p of its rows
    EngineChoice engine;
    double ok;                            ///< share of samples of the second half that are ok
    std::vector<double> mean;
    std::vector<double> scatter;          ///< standard deviation over time
    double noise = 0;                     ///< rms over the parameters that count, of scatter over value
    double perturbation = 0;              ///< the same of |mean - value|
    double error = 0;                     ///< root of the sum of their squares
};

/// What parameters are compared with.
struct Reference {
    bool free_run;                 ///< fitted to the free run's output error; else the consensus of those trials that agree best
    std::vector<double> values;    ///< by parameter
    std::vector<bool> counts;      ///< by parameter: it differs from zero by more than the steadiest trial scatters
};

struct Design {
    std::vector<Trial> curve;            ///< as the model is but for its window, shortest first
    std::vector<Trial> others;           ///< with other kappa or more rows
    Reference reference;
    std::optional<Trial> recommended;    ///< empty: no trial had estimates, or none of a parameter that rises above its scatter
    bool reached;                        ///< the recommended one has the accuracy asked for; where none was, an error of 1 at most
    std::vector<std::string> missing;    ///< what the recording does not excite
};

struct DesignOptions {
    std::optional<double> accuracy;   ///< relative error that is wanted; empty: the least
};

/// With an accuracy the shortest window that has it; else the shortest within a tenth of the least error. Another kappa or more rows are
/// recommended where they lessen the error by a fifth. Nullopt, and errors in `diagnostics`: the model has no estimator with windows, or the
/// recording does not fit it or is too short for two windows.
/// Cost: some forty replays and a fit of the free run.
std::optional<Design> design(const model::Model& model, const Recording& recording, const DesignOptions& options, Diagnostics& diagnostics,
                             const std::function<void(double)>& progress = {});

}  // namespace algest::lab
