// SPDX-License-Identifier: GPL-3.0-or-later
// The motor and the controller of examples/pmsm_drive in the closed loop of errata.md, "Setups behind these figures", with the
// motor's own constants. Commands act from their sample to the next.
#pragma once
#include <random>
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

/// From 20 rad/s and no current.
inline std::vector<PmsmSample> simulate(const Pmsm& motor, int samples) {
    using namespace pmsm_drive;
    std::mt19937_64 random(motor.seed);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    Controller controller(motor, motor.period, motor.direct_current ? DirectCurrent::for_most_torque : DirectCurrent::none);
    State state;
    std::vector<PmsmSample> out;
    for (int k = 0; k < samples; ++k) {
        const double noise_d = motor.current_noise * noise(random);
        const double noise_q = motor.current_noise * noise(random);
        const RotorFrame current{state.current.d + noise_d, state.current.q + noise_q};
        const RotorFrame v = controller.command(reference(k * motor.period), current, state.omega);
        out.push_back({v.d, v.q, current.d, current.q, state.omega});
        const double angle = motor.n_p * state.theta, rate = motor.n_p * state.omega;
        switch (motor.hold) {
            case Hold::rotor_frame: state = advance(motor, state, motor.period, v); break;
            case Hold::stator_frame:
                state = advance(motor, state, motor.period, held_in_stator_frame(v, angle, rate, motor.period));
                break;
            case Hold::stator_frame_no_advance:
                state = advance(motor, state, motor.period, to_stator_frame(v, angle));
                break;
        }
    }
    return out;
}

}  // namespace algest::plants
