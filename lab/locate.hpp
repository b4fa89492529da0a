// SPDX-License-Identifier: GPL-3.0-or-later
// Where a model is off: the weak residual of each equation over time and against the signals, sensor noise as the yardstick.
#pragma once
#include <vector>

#include "lab/discovery.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// Standard deviation of each signal's noise: declared noise and resolution, else the signal's own roughness; 0: not measured.
std::vector<double> noise_by_signal(const Variant& v);

/// The residual of every equation whose signals are measured, over the whole recording, each equation with the parameters that fit
/// it best on the training rows. amended: null where nothing was added.
std::vector<EquationResidual> residuals(const Workbench& bench, const Variant& nominal, const Variant* amended);

/// Share, stretch of time and region of each equation's gap on the training rows.
std::vector<Where> locate(const Workbench& bench, const Variant& nominal, const std::vector<EquationResidual>& residuals);

/// True when a residual of some equation can be foretold from the state: no noise does that.
bool structured(const Workbench& bench, const Variant& v);

}  // namespace algest::lab
