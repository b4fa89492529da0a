// SPDX-License-Identifier: GPL-3.0-or-later
// Where a model is off: the weak residual of each equation over time and against the signals, sensor noise as the yardstick.
#pragma once
#include <vector>

#include "lab/discovery.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// The residual of every equation whose signals are measured, over the whole recording, each equation with the parameters that fit
/// it best on the training rows. amended: null where nothing was added.
std::vector<EquationResidual> residuals(const Workbench& bench, const Variant& nominal, const Variant* amended);

/// Share, stretch of time and region of each equation's gap on the training rows: of its residual; where that is not to be had, for a
/// signal of the equation is not measured, or where no residual rises above the noise, of the free run's error in the signal that it moves.
/// Shares are 0 where the model runs within the noise.
std::vector<Where> locate(const Workbench& bench, const Variant& nominal, const std::vector<EquationResidual>& residuals, const FreeRun& before);

}  // namespace algest::lab
