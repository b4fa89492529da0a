// SPDX-License-Identifier: GPL-3.0-or-later
// The motor and the controller of examples/pmsm_drive in the closed loop of errata.md, "Setups behind these figures", with the
// motor's own constants. Commands act from their sample to the next.
#pragma once
#include <vector>

#include "examples/pmsm_drive/controller.hpp"
#include "examples/pmsm_drive/motor.hpp"

namespace algest::plants {

/// The frame in which a command stands still from its sample to the next.
enum class Hold {
    rotor_frame,
    stator_frame,             ///< laid where the rotor will be half a sample later
    stator_frame_no_advance,  ///< laid where the rotor is at the sample
};

struct Pmsm : pmsm_drive::Motor {
    double period = 1e-4;        ///< s
    double current_noise = 0.0;  ///< A, uniform in [-noise, noise] on both currents; the controller sees it too
    bool direct_current = true;  ///< false: i_d* = 0, and R is lost in noise
    unsigned seed = 1;
    Hold hold = Hold::rotor_frame;
};

struct PmsmSample {
    double v_d, v_q;  ///< V, as commanded from this sample to the next
    double i_d, i_q;  ///< A, as measured at this sample
    double omega;     ///< rad/s
};

/// From 20 rad/s and no current. In simulated_pmsm.cpp.
std::vector<PmsmSample> simulate(const Pmsm& motor, int samples);

}  // namespace algest::plants
