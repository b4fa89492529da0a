// SPDX-License-Identifier: GPL-3.0-or-later
// What an estimator costs on its controller: multiply-adds, bytes of memory and of tables, as the runtime's loops and the emitted class have them.
#pragma once
#include <string>
#include <vector>

#include "generator/generate.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// Besides the solve and the formulas of signals and parameters.
struct Cost {
    long rows;             ///< multiply-adds of one evaluation of the rows
    long push;             ///< multiply-adds
    long estimate;         ///< multiply-adds
    long whitening;        ///< multiply-adds of estimate() beside, where rows are whitened
    long uncertainty;      ///< multiply-adds, where noise is declared
    long instance_bytes;
    long table_bytes;      ///< constant and shared
    int operations;        ///< of the floating-point unit in one multiply-add of push()
};
Cost cost_of(const plan::Plan& plan);

struct EngineCost {
    std::string engine;   ///< "fir" or "moments"
    Cost cost;
};
/// Of the model's estimator, then of what the other engine would make of it, unless the model cannot have that. Empty where there is no estimator.
/// Cost: two plans.
std::vector<EngineCost> engine_costs(const std::string& path, PlanOptions options);

/// Of an accumulator of moments; both hold eight.
constexpr int accumulator_bytes = 8;

}  // namespace algest::generator
