// SPDX-License-Identifier: 0BSD
// Where no measured recording is at hand: a linear axis with the published parameters of the EMPS benchmark, moved to and fro by a
// position controller. Writes the recording to standard output. The force is held over each millisecond, the encoder counts 0.1 um.
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <cstdio>

int main() {
    constexpr double mass = 95.11, viscous = 203.5, coulomb = 20.39, offset = -3.16;   // kg, N.s/m, N, N (Janot et al. 2019)
    constexpr double period = 1e-3, duration = 12.0, count = 1e-7;
    constexpr double pi = 3.14159265358979323846;
    using State = std::array<double, 2>;   // position, speed
    State x = {0.0, 0.0};
    boost::numeric::odeint::runge_kutta4<State> stepper;
    std::printf("t [s],qm [m],force [N]\n");
    for (int k = 0; k < static_cast<int>(duration / period); ++k) {
        const double t = k * period;
        const double wanted = 0.08 * std::sin(2 * pi * 0.25 * t) + 0.02 * std::sin(2 * pi * 0.9 * t);
        const double measured = std::round(x[0] / count) * count;
        const double force = 2.4e5 * (wanted - measured) - 3.0e3 * x[1];
        std::printf("%.3f,%.7f,%.6f\n", t, measured, force);
        const auto motion = [&](const State& s, State& rate, double) {
            rate[0] = s[1];
            rate[1] = (force - viscous * s[1] - coulomb * std::tanh(s[1] / 1e-4) - offset) / mass;
        };
        for (int part = 0; part < 20; ++part) stepper.do_step(motion, x, t + part * period / 20, period / 20);
    }
    return 0;
}
