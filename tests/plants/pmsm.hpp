// SPDX-License-Identifier: GPL-3.0-or-later
// The PMSM of Delpoux, Floquet (000) in the rotor frame, equation (21), in the closed loop of errata.md, "Setups behind
// these figures". Commands act from their sample to the next, held in the rotor frame.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/plants/advance.hpp"

namespace algest::plants {

struct Pmsm {
    double R = 3.01;             ///< ohm
    double L = 9e-3;             ///< H
    double K = 0.27;             ///< N.m/A
    double J = 3.18e-4;          ///< kg.m^2
    double n_p = 50.0;           ///< pole pairs
    double period = 1e-4;        ///< s
    double current_noise = 0.0;  ///< A, uniform in [-noise, noise] on both currents; the controller sees it too
    bool direct_current = true;  ///< false: i_d* = 0, and R is lost in noise
    unsigned seed = 1;

    double friction(double omega) const { return 2.4e-4 * omega + 0.0752 * std::tanh(omega / 0.5); }  // N.m
};

struct PmsmSample {
    double v_d, v_q;  ///< V, from this sample to the next
    double i_d, i_q;  ///< A, as measured at this sample
    double omega;     ///< rad/s
};

/// The controller of errata.md, with the motor's own constants.
class PmsmController {
public:
    explicit PmsmController(const Pmsm& motor) : motor_(motor) {}

    /// The command at time t; moves the integrals by one period.
    void command(double t, PmsmSample& s) {
        using std::numbers::pi;
        const auto& [R, L, K, J, n_p, period, noise, direct, seed] = motor_;
        const double wanted = 20.0 + 5.0 * std::sin(2.0 * pi * 5.0 * t);
        const double wanted_rate = 5.0 * 2.0 * pi * 5.0 * std::cos(2.0 * pi * 5.0 * t);
        const double speed_error = wanted - s.omega;
        const double torque = 0.08 * speed_error + 1.5 * speed_integral_ + J * wanted_rate;
        const double i_q = std::clamp(torque / K, -3.0, 3.0);
        const double back_emf = n_p * L * wanted;
        const double i_d = direct ? -n_p * L * K * wanted * wanted / (R * R + back_emf * back_emf) : 0.0;
        const double error_d = i_d - s.i_d;
        const double error_q = i_q - s.i_q;
        s.v_d = std::clamp(6.0 * error_d + 1500.0 * integral_d_ - back_emf * i_q, -30.0, 30.0);
        s.v_q = std::clamp(6.0 * error_q + 1500.0 * integral_q_ + back_emf * i_d + K * wanted, -30.0, 30.0);
        speed_integral_ += speed_error * period;
        integral_d_ += error_d * period;
        integral_q_ += error_q * period;
    }

private:
    Pmsm motor_;
    double speed_integral_ = 0.0;
    double integral_d_ = 0.0;
    double integral_q_ = 0.0;
};

/// From 20 rad/s and no current.
inline std::vector<PmsmSample> simulate(const Pmsm& motor, int samples) {
    std::mt19937_64 random(motor.seed);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    PmsmController controller(motor);
    std::array<double, 3> state{0.0, 0.0, 20.0};  // i_d, i_q, omega
    std::vector<PmsmSample> out;
    for (int k = 0; k < samples; ++k) {
        PmsmSample s{};
        s.i_d = state[0] + motor.current_noise * noise(random);
        s.i_q = state[1] + motor.current_noise * noise(random);
        s.omega = state[2];
        controller.command(k * motor.period, s);
        out.push_back(s);
        advance(state, k * motor.period, (k + 1) * motor.period, [&](const auto& x, auto& dxdt, double) {
            dxdt[0] = (s.v_d - motor.R * x[0] + motor.n_p * motor.L * x[2] * x[1]) / motor.L;
            dxdt[1] = (s.v_q - motor.R * x[1] - motor.n_p * motor.L * x[2] * x[0] - motor.K * x[2]) / motor.L;
            dxdt[2] = (motor.K * x[1] - motor.friction(x[2])) / motor.J;
        });
    }
    return out;
}

}  // namespace algest::plants
