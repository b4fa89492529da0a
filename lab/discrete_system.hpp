// SPDX-License-Identifier: GPL-3.0-or-later
// The transfer function that a discrete-time estimator found: both parametrisations, poles and zeros.
#pragma once
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "generator/plan.hpp"
#include "lab/replay.hpp"

namespace algest::lab {

/// Coefficients as algest/transfer_function.hpp has them, lowest power first; poles and zeros sorted by size, then by imaginary part.
struct DiscreteSystem {
    std::vector<double> a, b;                    ///< of z: a_0 .. a_n = 1, b_0 ..
    std::vector<double> A, B;                    ///< of q: A_1 .. A_n, B_0 ..
    std::vector<std::complex<double>> poles_z;
    std::vector<std::complex<double>> zeros_z;   ///< that were estimated; those that were preset lie at -1
    std::vector<std::complex<double>> poles_s;   ///< rad/s, by z = exp(s period)
};

/// Of the values of plan.parameters; nullopt where the plan is not discrete-time or a number of it is not finite (a pole at z = 0 or infinity).
/// Cost: two or three searches for roots.
std::optional<DiscreteSystem> discrete_system(const plan::Plan& plan, const std::vector<double>& parameters);

/// What to change where no sample of a replay is ok because rows in z lose their digits at a short period; nullopt: it is not that.
std::optional<std::string> advice_on_domain(const plan::Plan& plan, const Replay& replay);

}  // namespace algest::lab
