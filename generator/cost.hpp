// SPDX-License-Identifier: GPL-3.0-or-later
// What an estimator costs on its controller: multiply-adds, bytes of memory and of tables, as the runtime's loops and the emitted class have them.
#pragma once
#include "generator/plan.hpp"

namespace algest::generator {

/// Besides the solve and the formulas of signals and parameters.
struct Cost {
    long rows;             ///< multiply-adds of one evaluation of the rows
    long push;             ///< multiply-adds
    long estimate;         ///< multiply-adds
    long instance_bytes;
    long table_bytes;      ///< constant and shared
    int operations;        ///< of the floating-point unit in one multiply-add of push()
};
Cost cost_of(const plan::Plan& plan);

int scalar_bytes(const plan::Plan& plan);
/// Of an accumulator of moments; both hold eight.
constexpr int accumulator_bytes = 8;

}  // namespace algest::generator
