// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a plan that stands can be served: the runtime's counters, and the range of the scalar.
#pragma once
#include "generator/diagnostics.hpp"
#include "generator/model.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// False after an error at the model's [sampling].
bool within_limits(const model::Model& model, const plan::Plan& plan, Diagnostics& diagnostics);

}  // namespace algest::generator
