// SPDX-License-Identifier: 0BSD
// The closed loop: noisy currents, the controller at 10 kHz, the estimator at 1 kHz, which retunes the controller.
#pragma once
#include <random>
#include <vector>

#include "controller.hpp"
#include "estimator_input.hpp"
#include "motion.hpp"

namespace pmsm_drive {

constexpr double period = 1e-4;         ///< s
constexpr double fed_from = 0.4;        ///< s: the estimator gets its first sample; before, the wrong constants have settled
constexpr double duration = 1.4;        ///< s
constexpr double current_noise = 0.03;  ///< A, uniform, 1 percent of the sensors' range

/// How the drive holds a command over a period.
enum class Hold {
    rotor_frame,
    stator_frame,
};

struct Instant {
    double t;  ///< s
    Reference wanted;
    State motor;
    RotorFrame voltage;  ///< V, held from here on
    algest::generated::PmsmElectrical::Estimate estimate;
    bool fed;      ///< the estimator gets samples
    bool retuned;  ///< the controller has had an estimate
};

/// One run, an instant every period.
inline std::vector<Instant> run(Hold hold) {
    algest::generated::PmsmElectrical estimator;
    auto estimate = estimator.estimate();  // nothing pushed yet: the initial values of the model file, wrong on purpose
    bool retuned = false;
    Constants believed;
    believed.R = estimate.R;
    believed.L = estimate.L;
    believed.K = estimate.K;
    Controller controller(believed, period);
    EstimatorInput input;

    std::mt19937 random(1);
    const auto noise = [&] { return current_noise * (static_cast<double>(random()) / 2147483648.0 - 1.0); };
    const Motor motor;
    State state;
    std::vector<Instant> out;
    for (int k = 0; k < static_cast<int>(duration / period + 0.5); ++k) {
        const double t = k * period;
        const bool fed = t > fed_from - 0.5 * period;
        const Reference wanted = reference(t);
        const double noise_d = noise(), noise_q = noise();
        const RotorFrame current{state.current.d + noise_d, state.current.q + noise_q};
        const RotorFrame voltage = controller.command(wanted, current, state.omega);
        out.push_back({t, wanted, state, voltage, estimate, fed, retuned});

        const double angle = motor.n_p * state.theta, rate = motor.n_p * state.omega;
        const RotorFrame acting = hold == Hold::rotor_frame ? voltage : fed_for_stator_hold(voltage, rate, period);
        if (fed && input.add(current, state.omega, acting)) {
            estimate = estimator.step(input.sample());
            if (estimate.status == algest::Status::ok) {
                controller.retune(estimate.R, estimate.L, estimate.K);
                retuned = true;
            }
        }
        state = hold == Hold::rotor_frame
                    ? advance(motor, state, period, voltage)
                    : advance(motor, state, period, held_in_stator_frame(voltage, angle, rate, period));
    }
    return out;
}

}  // namespace pmsm_drive
