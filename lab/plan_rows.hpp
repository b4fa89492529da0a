// SPDX-License-Identifier: GPL-3.0-or-later
// The rows that an estimator makes of a recording, all of them at hand at once.
#pragma once
#include <vector>

#include "generator/plan.hpp"
#include "lab/stacked_rows.hpp"
#include "lab/stretch.hpp"

namespace algest::lab {

/// Values of the plan's rings at every sample of the stretch, one sample a column; derivatives by the parabola filter, centred. inputs: whole columns
/// of the recording; t: instants of the samples, s. The plan delays and decimates nothing. Cost: the plan's formulas, each sample.
Eigen::MatrixXd ring_values(const plan::Plan& plan, const std::vector<std::vector<double>>& inputs, const std::vector<double>& t, RowRange rows);

/// The rows of every `stride`-th instant. Those at which a signal of the window is not finite are left out, as the estimator refuses such samples.
/// Cost: the rows' dot products, each instant.
StackedRows plan_rows(const plan::Plan& plan, const Eigen::MatrixXd& rings, int stride);

}  // namespace algest::lab
