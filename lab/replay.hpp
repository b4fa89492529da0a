// SPDX-License-Identifier: GPL-3.0-or-later
// An estimator run over a recording, sample by sample, as it would have run on the machine.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algest/status.hpp"
#include "generator/diagnostics.hpp"
#include "generator/plan.hpp"
#include "lab/operating_points.hpp"
#include "lab/recording.hpp"
#include "lab/stretch.hpp"

namespace algest::lab {

/// What the estimator said at each sample. Values in float estimators are those floats, exactly.
struct Replay {
    std::vector<double> t;  ///< s
    std::vector<Status> status;
    std::vector<double> condition;   ///< infinity unless the status is ok or singular
    std::vector<double> parameters;  ///< samples x parameters
    std::size_t parameter_count;
    std::vector<double> deviations = {};   ///< samples x parameters, NaN where none was computed; empty: none were
    std::vector<double> biases = {};       ///< likewise: what the noise in the regressors adds to the estimate on average
    OperatingPoints points = {};           ///< of the functional average
    std::vector<EliminationCandidate> candidates = {};   ///< of an elimination, with all rows

    std::size_t samples() const { return t.size(); }
    double parameter(std::size_t sample, std::size_t p) const { return parameters[sample * parameter_count + p]; }
    double deviation(std::size_t sample, std::size_t p) const { return deviations[sample * parameter_count + p]; }
    double bias(std::size_t sample, std::size_t p) const { return biases[sample * parameter_count + p]; }
};

/// Of a Replay. Empty where no sample is ok.
struct ReplaySummary {
    std::array<std::size_t, 4> count{};         ///< samples by Status
    std::vector<std::optional<double>> last;    ///< by parameter: held at the end of the stretch
    std::vector<std::optional<double>> median;  ///< by parameter, over ok samples
    std::vector<std::optional<double>> deviation;   ///< by parameter, of the last ok sample
    std::vector<std::optional<double>> bias;        ///< likewise
    std::optional<double> condition_median;     ///< over ok samples
    std::optional<double> condition_last;       ///< of the last ok sample
};

/// Told now and then how much is done, 0 to 1.
using ProgressReport = std::function<void(double)>;

/// Runs the plan, in its own scalar, over the stretch. Nullopt, and errors in `diagnostics`, if a signal's column is missing
/// or in a unit that does not convert, if the periods differ, or if the stretch is too short for one estimate.
/// Cost: HostEstimator::step a sample. Memory: (parameters + 3) * 8 bytes a sample.
std::optional<Replay> replay(const plan::Plan& plan, const Recording& recording, const Stretch& stretch,
                             Diagnostics& diagnostics, const ProgressReport& progress = {});

/// Adds standard deviations and biases, by the runtime's uncertainty(), at the last ok sample and at evenly spaced ok ones, `most` to twice as many, in a
/// second run over what was replayed: at every sample they would cost a thousand times the estimates. Nothing where the plan declares no noise.
/// Cost: HostEstimator::step a sample, HostEstimator::uncertainty for each of them.
void add_deviations(const plan::Plan& plan, const Recording& recording, std::size_t most, Replay& replay, const ProgressReport& progress = {});

/// From one of those samples to the next, counted in ok ones, of which there are `ok`: a power of two, so that few of them are among many.
std::size_t deviation_stride(std::size_t ok, std::size_t most);

/// Cost: samples * parameters.
ReplaySummary summarise(const Replay& replay);

/// The replay as CSV: `t [s]`, `status`, `condition` (empty while there is none), `NAME [unit]` a
/// parameter (`NAME` where no unit is declared), then `sd(NAME) [unit]` a parameter where deviations were computed, empty at other samples. Numbers have the shortest digits that read back to the same bits in the
/// plan's scalar. Cost: samples * parameters.
std::string replay_csv(const plan::Plan& plan, const Replay& replay);

}  // namespace algest::lab
