// SPDX-License-Identifier: GPL-3.0-or-later
// Systems that are linear while no relay switches: from one sample to the next in one exact step.
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "lab/ode_system.hpp"

namespace algest::lab {

/// True when every state's rate is  A x + b(t), A of parameters alone and b(t) straight between samples, however it came about at the samples:
/// inputs, laws, relays; inputs that come late, by whole samples. held: by signal, constant between samples. Systems that delay what moves, have
/// layers, or differentiate an input, are none.
bool is_linear(const OdeSystem& system, const std::vector<bool>& held);

/// x(t+h) = x + h phi1 x'(t) + h phi2 (x'(x, t+h) - x'(x, t)): exact where is_linear, the rate's slope in time taken at an unmoved state.
struct LinearStep {
    Eigen::MatrixXd phi1;   ///< h (e^(hA) - 1)/(hA)
    Eigen::MatrixXd phi2;   ///< h (e^(hA) - 1 - hA)/(hA)^2
};
LinearStep linear_step(const Eigen::MatrixXd& a, double h);

}  // namespace algest::lab
