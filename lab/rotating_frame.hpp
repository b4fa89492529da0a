// SPDX-License-Identifier: GPL-3.0-or-later
// The two voltage equations of a machine in a frame that turns with its rotor, found by their cross coupling.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"

namespace algest::lab {

/// d: L*der(i_d) = ... + p*speed*L*i_q,  q: L*der(i_q) = ... - p*speed*L*i_d.
struct RotatingFrame {
    std::size_t d_equation;
    std::size_t q_equation;
    std::string d_current;
    std::string q_current;
    std::string angle;       ///< formula of the electrical angle, e.g. "n_p*th"
    std::string speed;       ///< of the rotor
    std::string pairs;       ///< of poles: a constant, or a number
};

/// Nullopt where no two equations are coupled so, or where nothing integrates the speed to a measured angle.
/// The number of pole pairs is that of the coupling, at the parameters' initial values, and is written as the constant that has it.
std::optional<RotatingFrame> rotating_frame(const model::Model& model, const std::vector<bool>& measured);

}  // namespace algest::lab
