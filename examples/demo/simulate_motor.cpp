// SPDX-License-Identifier: 0BSD
// A DC motor with one effect that motor.toml does not know, chosen and sized by a seed:
//   simulate_motor SEED RECORDING.csv HIDDEN.txt
// Steps of voltage both ways every 0.12 s, held over each millisecond; noise on current and speed as motor.toml declares it.
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

int main(int count, char** words) {
    if (count != 4) return std::fprintf(stderr, "usage: simulate_motor SEED RECORDING.csv HIDDEN.txt\n"), 2;
    const unsigned long seed = std::strtoul(words[1], nullptr, 10);
    std::mt19937 dice(static_cast<std::mt19937::result_type>(seed));
    const auto between = [&](double low, double high) { return low + (high - low) * (static_cast<double>(dice()) / 4294967296.0); };
    std::normal_distribution<double> normal;

    constexpr double R = 1.0, L = 0.002, K = 0.05, J = 2.5e-4, b = 2e-4;   // ohm, H, N.m/A, kg.m^2, N.m.s/rad
    double friction = 0, offset = 0, drag = 0, load = 0;
    std::FILE* hidden = std::fopen(words[3], "w");
    std::FILE* out = std::fopen(words[2], "w");
    if (hidden == nullptr || out == nullptr) return std::fprintf(stderr, "simulate_motor: cannot write\n"), 2;
    const double side = between(0, 1) < 0.5 ? -1 : 1;
    switch (seed % 4) {
        case 0: std::fprintf(hidden, "quadratic_drag in torque balance, kq = %.3g N.m/(rad/s)^2\n", drag = between(1e-6, 3e-6)); break;
        case 1: std::fprintf(hidden, "coulomb_friction in torque balance, Tc = %.3g N.m\n", friction = between(0.005, 0.02)); break;
        case 2: std::fprintf(hidden, "voltage_offset in voltage balance, V0 = %.3g V\n", offset = side * between(0.2, 0.6)); break;
        default: std::fprintf(hidden, "constant_load in torque balance, T0 = %.3g N.m\n", load = side * between(0.005, 0.02)); break;
    }
    std::fclose(hidden);

    using State = std::array<double, 2>;   // current, speed
    State x = {0.0, 0.0};
    boost::numeric::odeint::runge_kutta4<State> stepper;
    constexpr double period = 1e-3;
    double u = 0;
    std::fprintf(out, "t [s],u [V],i [A],w [rad/s]\n");
    for (int k = 0; k < 5000; ++k) {
        if (k % 120 == 0) u = between(-8, 8);
        std::fprintf(out, "%.3f,%.6f,%.6f,%.5f\n", k * period, u, x[0] + 0.005 * normal(dice), x[1] + 0.1 * normal(dice));
        const auto motion = [&](const State& s, State& rate, double) {
            rate[0] = (u + offset - R * s[0] - K * s[1]) / L;
            rate[1] = (K * s[0] - b * s[1] - friction * std::tanh(s[1] / 0.02) - drag * s[1] * std::fabs(s[1]) - load) / J;
        };
        for (int part = 0; part < 20; ++part) stepper.do_step(motion, x, 0.0, period / 20);
    }
    return std::fclose(out) == 0 ? 0 : 2;
}
