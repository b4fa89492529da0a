// SPDX-License-Identifier: GPL-3.0-or-later
// Which engine serves the windows, and the numbers of windowed moments.
#pragma once
#include <optional>
#include <string>

#include "generator/model.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// Largest degree of a kernel's polynomial that moments serve.
constexpr int largest_moment_degree = 10;

/// False, with an error, where the model asks for growing windows and the functional has none.
bool growing_serves(const model::Model& model, Diagnostics& diagnostics);

/// The moments of a plan whose tables and rows stand. asked: the engine that goes over the model's; may be empty. Empty where fir serves: because
/// it is asked for, or, with a note in the plan that says why, because moments will not do. A growing window that only moments could serve
/// is then an error.
std::optional<plan::Moments> moments(const model::Model& model, const std::string& asked, plan::Plan& plan, Diagnostics& diagnostics);

}  // namespace algest::generator
