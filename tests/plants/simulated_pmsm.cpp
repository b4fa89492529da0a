// SPDX-License-Identifier: GPL-3.0-or-later
#include <random>

#include "examples/pmsm_drive/motion.hpp"
#include "tests/plants/pmsm.hpp"

namespace algest::plants {

std::vector<PmsmSample> simulate(const Pmsm& motor, int samples) {
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
