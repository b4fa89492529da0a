// SPDX-License-Identifier: 0BSD
// Writes the recording of this folder to standard output: the motor at twelve operating points of 0.4 s each, 0.1 s of ramp between them, sampled
// every millisecond; uniform errors of +-30 mA on the measured currents.
#include <cmath>
#include <cstdio>
#include <random>

#include "equilibrium.hpp"

int main() {
    const sensorless_motor::Motor motor;
    std::mt19937 bits(1);
    const auto error = [&] { return 0.03 * (2.0 * static_cast<double>(bits()) / 4294967295.0 - 1.0); };
    std::printf("t [s],v_a [V],v_b [V],i_a [A],i_b [A],theta_r [rad],omega_r [rad/s]\n");
    double angle = 0, before = 2;
    int k = 0;
    for (const double omega : {2.0, 4.0, 6.0, 9.0, 12.0, 34.0}) {
        for (const double I_max : {1.5, 3.0}) {
            for (int i = 0; i < 500; ++i, ++k) {
                const double speed = i < 100 ? before + (omega - before) * i / 100 : omega;
                const auto p = sensorless_motor::controlled(motor, speed, I_max, 0);
                const double c = std::cos(motor.n_p * angle), s = std::sin(motor.n_p * angle);
                std::printf("%.3f,%.4f,%.4f,%.4f,%.4f,%.7f,%.3f\n", k * 1e-3, p.v_f * c - p.v_g * s, p.v_f * s + p.v_g * c, p.i_f * c - p.i_g * s + error(),
                            p.i_f * s + p.i_g * c + error(), angle, speed);
                angle += 1e-3 * speed;
            }
            before = omega;
        }
    }
    return 0;
}
