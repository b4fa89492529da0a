// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a discovery's report, as data: what is drawn against what, over which stretch.
#pragma once
#include <optional>
#include <vector>

#include "generator/model.hpp"
#include "lab/discovery.hpp"
#include "lab/figure.hpp"
#include "lab/output_figure.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// Measured, before and after over the test stretch, and the errors below.
/// Nullopt where the signal is not measured or not simulated, or the test stretch has no sample.
std::optional<OutputFigure> test_figure(const Discovery& discovery, const model::Model& model, const Recording& recording, const OutputGap& output);

/// The residual of an equation over time, with the noise band and the stretches. Nullopt without windows.
std::optional<Figure> time_figure(const Discovery& discovery, const EquationResidual& residual);

/// Against the signal that explains it: what the equation of the amended model leaves without the added terms, with what these say, and
/// beside it what is left with them; the residual before, where no term was added to this equation. Nullopt where no signal explains it.
std::optional<Figure> law_figure(const EquationResidual& residual);

}  // namespace algest::lab
