// SPDX-License-Identifier: GPL-3.0-or-later
// The figure of one output: measured and simulated above, the errors with the noise band below, a detail beside them where it is dense.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "lab/figure.hpp"
#include "lab/free_run.hpp"

namespace algest::lab {

/// A simulated run beside the measurement.
struct DrawnRun {
    std::string title;
    std::string colour;            ///< #rrggbb
    std::vector<double> values;    ///< by sample; NaN where the run has ended
};

struct OutputFigure {
    Figure figure;
    double noise;                  ///< standard deviation, in the signal's unit; 0: not declared
    bool detail;                   ///< the first run is off most there
    std::vector<bool> diverges;    ///< by run: it ends or leaves the picture inside the stretch
};

/// The signal over the instants t, in s; `measured` by sample, empty for a signal that nothing measures: then the errors are left out.
/// The last run is drawn on top and its errors are shown furthest. `heading` stands above the axes. Nullopt with fewer than two samples.
std::optional<OutputFigure> output_figure(const model::Signal& signal, const std::vector<double>& t, const std::vector<double>& measured,
                                          const std::vector<DrawnRun>& runs, double noise, const std::string& heading);

/// A run's signal at a sample of the recording; NaN where the run has none.
double run_value(const FreeRun& run, std::size_t signal, std::size_t row);

}  // namespace algest::lab
