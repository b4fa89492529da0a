// SPDX-License-Identifier: 0BSD
// Velocity control of the motor: a speed loop, two current loops, and feed-forward from the constants that are believed.
#pragma once
#include <algorithm>

#include "constants.hpp"
#include "frames.hpp"
#include "reference.hpp"

namespace pmsm_drive {

/// A direct current is what makes R, L and K identifiable: without it R is lost in the noise of the sensors.
enum class DirectCurrent {
    for_most_torque,  ///< at the voltage's limit: Verl, Bodson 1998, as section 4.1.3 of the paper has it
    none,
};

class Controller {
public:
    /// period [s]: command() is called once in each.
    Controller(const Constants& believed, double period, DirectCurrent direct = DirectCurrent::for_most_torque)
        : believed_(believed), period_(period), direct_(direct) {}

    /// From the next command on.
    void retune(double R, double L, double K) {
        believed_.R = R;
        believed_.L = L;
        believed_.K = K;
    }

    /// The voltage [V] for the coming period, from the currents [A] and the speed [rad/s] as measured now.
    RotorFrame command(const Reference& wanted, const RotorFrame& current, double omega) {
        const auto& [R, L, K, J, n_p] = believed_;
        const double speed_error = wanted.omega - omega;
        const double torque = 0.08 * speed_error + 1.5 * speed_integral_ + J * wanted.acceleration;
        const double reactance = n_p * L * wanted.omega;
        const RotorFrame target{direct_ == DirectCurrent::none
                                    ? 0.0
                                    : -n_p * L * K * wanted.omega * wanted.omega / (R * R + reactance * reactance),
                                limited(torque / K, 3.0)};
        const RotorFrame error{target.d - current.d, target.q - current.q};
        const RotorFrame voltage{
            limited(6.0 * error.d + 1500.0 * integral_.d - reactance * target.q, 30.0),
            limited(6.0 * error.q + 1500.0 * integral_.q + reactance * target.d + K * wanted.omega, 30.0)};
        speed_integral_ += speed_error * period_;
        integral_.d += error.d * period_;
        integral_.q += error.q * period_;
        return voltage;
    }

private:
    static double limited(double x, double most) { return std::clamp(x, -most, most); }

    Constants believed_;
    double period_;
    DirectCurrent direct_;
    double speed_integral_ = 0.0;    // rad
    RotorFrame integral_{0.0, 0.0};  // A.s
};

}  // namespace pmsm_drive
