// SPDX-License-Identifier: 0BSD
// The simulated motor: its constants, its friction, its state. Yours is the real one.
#pragma once
#include <cmath>

#include "constants.hpp"
#include "frames.hpp"

namespace pmsm_drive {

struct Motor : Constants {
    double friction(double omega) const { return 2.4e-4 * omega + 0.0752 * std::tanh(omega / 0.5); }  ///< N.m
};

struct State {
    RotorFrame current{0.0, 0.0};  ///< A
    double omega = 20.0;           ///< rad/s
    double theta = 0.0;            ///< rad, mechanical
};

}  // namespace pmsm_drive
