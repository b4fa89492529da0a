// SPDX-License-Identifier: GPL-3.0-or-later
// A free run of a model beside the recording of its machine: what is simulated, and how far it is from what was measured.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/model.hpp"
#include "lab/free_run.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// A model with a recording of its machine, ready to be run with any parameters.
struct Bench {
    OdeSystem system;
    Drive drive;
    std::vector<std::vector<double>> measured;   ///< by the model's signals, in its units; empty: not measured
    std::vector<double> initial;                 ///< by state entry: declared, else from the first samples, else 0
    RunOptions options;
};

/// Nullopt, and errors in `diagnostics`, where the model cannot be simulated, a signal that drives it is not in the recording, a unit
/// does not convert, or the periods differ. A hidden state without `initial` starts at 0, with a note.
std::optional<Bench> bench(const model::Model& model, const Recording& recording, Diagnostics& diagnostics);

/// The model's initial values of its parameters, with those of `set` in their place. Nullopt, and errors in `diagnostics`, where
/// one has neither, or `set` names none of the model's parameters.
std::optional<std::vector<double>> parameter_values(const model::Model& model, const std::map<std::string, double>& set, Diagnostics& diagnostics);

/// One simulated signal beside its measurement.
struct OutputError {
    int signal;
    double rmse;     ///< in the signal's unit
    double nrmse;    ///< rmse / max(std, 0.1 rms) of the whole measured signal
};

/// max(std, 0.1 rms) of a measured signal: what an error is compared with.
double size_of(const std::vector<double>& measured);

/// Errors over rows [begin, end) of every simulated signal that is measured and scored.
std::vector<OutputError> output_errors(const model::Model& model, const Bench& bench, const FreeRun& run, std::size_t begin, std::size_t end);

/// `t [s]` and every simulated signal, as CSV. model: the one that was run.
std::string run_csv(const model::Model& model, const Recording& recording, const FreeRun& run);

}  // namespace algest::lab
