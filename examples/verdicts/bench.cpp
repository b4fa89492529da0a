// SPDX-License-Identifier: 0BSD
// A DC motor on four benches, each recorded for one verdict of `algest discover` (docs/verdict-*.md); ../demo/motor.toml knows copper,
// inertia and viscous friction:
//   bench named|ambiguous|none|unknown RECORDING.csv
// named: dry friction of a gear, steps of voltage both ways. ambiguous: the same gear, which only ever turns forward. none: nothing beside the
// model. unknown: an eddy-current brake, whose torque falls beyond 60 rad/s.
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

int main(int count, char** words) {
    const auto is = [&](const char* what) { return count == 3 && std::strcmp(words[1], what) == 0; };
    if (!is("named") && !is("ambiguous") && !is("none") && !is("unknown")) return std::fprintf(stderr, "usage: bench named|ambiguous|none|unknown RECORDING.csv\n"), 2;
    std::FILE* out = std::fopen(words[2], "w");
    if (out == nullptr) return std::fprintf(stderr, "bench: cannot write %s\n", words[2]), 2;
    std::mt19937 dice(7);
    const auto between = [&](double low, double high) { return low + (high - low) * (static_cast<double>(dice()) / 4294967296.0); };
    const auto normal = [&] {
        const double radius = std::sqrt(-2 * std::log(1 - between(0, 1)));
        const double angle = 2 * M_PI * between(0, 1);
        return radius * std::cos(angle);
    };

    constexpr double R = 1.0, L = 0.002, K = 0.05, J = 2.5e-4, b = 2e-4;   // ohm, H, N.m/A, kg.m^2, N.m.s/rad
    const double friction = is("named") || is("ambiguous") ? 0.012 : 0;      // N.m
    const double brake = is("unknown") ? 0.03 : 0;                           // N.m, at its peak
    constexpr double peak = 60;                                              // rad/s
    const bool forward = is("ambiguous");

    using State = std::array<double, 2>;   // current, speed
    State x = {0.0, forward ? 60.0 : 0.0};
    boost::numeric::odeint::runge_kutta4<State> stepper;
    constexpr double period = 1e-3;
    double u = 0;
    std::fprintf(out, "t [s],u [V],i [A],w [rad/s]\n");
    for (int k = 0; k < 5000; ++k) {
        if (k % 120 == 0) u = forward ? between(2, 8) : between(-8, 8);
        const double i_noise = 0.005 * normal();
        const double w_noise = 0.1 * normal();
        std::fprintf(out, "%.3f,%.6f,%.6f,%.5f\n", k * period, u, x[0] + i_noise, x[1] + w_noise);
        const auto motion = [&](const State& s, State& rate, double) {
            const double w = s[1] / peak;
            rate[0] = (u - R * s[0] - K * s[1]) / L;
            rate[1] = (K * s[0] - b * s[1] - friction * std::tanh(s[1] / 0.02) - brake * 2 * w / (1 + w * w)) / J;
        };
        for (int part = 0; part < 20; ++part) stepper.do_step(motion, x, 0.0, period / 20);
    }
    return std::fclose(out) == 0 ? 0 : 2;
}
