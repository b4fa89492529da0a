// SPDX-License-Identifier: 0BSD
// The last step of docs/tutorial.md: the speed of a motor follows a wanted one, by constants from its data sheet; after 2 s by those that the
// generated estimator has found. The motor is that of ../demo/simulate_motor.cpp with seed 1. Prints what that changes:
//   controller RUN.csv
#include <array>
#include <cmath>
#include <cstdio>
#include <motor/motor.hpp>
#include <random>

namespace {

constexpr double period = 1e-3;   // s
constexpr double K = 0.05;        // N.m/A, from the data sheet and right

struct Constants {
    double R, J, b, Tc;   // ohm, kg.m^2, N.m.s/rad, N.m
};
constexpr Constants data_sheet = {1.2, 3e-4, 1e-4, 0};   // no data sheet tells the friction of your gear
constexpr Constants truth = {1.0, 2.5e-4, 2e-4, 0.02};

/// What the speed is to be, and how fast that changes.
struct Wanted {
    double speed, slope;   // rad/s, rad/s^2
};
Wanted wanted_at(double t) {
    const double slow = 6, fast = 17;   // rad/s
    return {60 * std::sin(slow * t) + 20 * std::sin(fast * t), 60 * slow * std::cos(slow * t) + 20 * fast * std::cos(fast * t)};
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The voltage that the model asks for, and a PI controller for the rest.
class Controller {
public:
    double command(const Wanted& wanted, double speed) {
        const double current = (c_.J * wanted.slope + c_.b * wanted.speed + c_.Tc * sign(wanted.speed)) / K;
        const double error = wanted.speed - speed;
        sum_ += error * period;
        return c_.R * current + K * wanted.speed + 0.05 * error + 0.5 * sum_;
    }
    void retune(const Constants& c) { c_ = c; }

private:
    Constants c_ = data_sheet;
    double sum_ = 0;
};

/// Current and speed, one period later: Runge and Kutta in 20 steps, the voltage held.
using State = std::array<double, 2>;
State slopes(const State& x, double voltage) {
    return {(voltage - truth.R * x[0] - K * x[1]) / 0.002, (K * x[0] - truth.b * x[1] - truth.Tc * std::tanh(x[1] / 0.02)) / truth.J};
}
State moved(const State& x, const State& by, double time) { return {x[0] + time * by[0], x[1] + time * by[1]}; }
State advance(State x, double voltage) {
    const double step = period / 20;
    for (int k = 0; k < 20; ++k) {
        const State one = slopes(x, voltage), two = slopes(moved(x, one, step / 2), voltage), three = slopes(moved(x, two, step / 2), voltage), four = slopes(moved(x, three, step), voltage);
        for (std::size_t m = 0; m < 2; ++m) x[m] += step / 6 * (one[m] + 2 * two[m] + 2 * three[m] + four[m]);
    }
    return x;
}

}  // namespace

int main(int count, char** words) {
    std::FILE* const out = count == 2 ? std::fopen(words[1], "w") : nullptr;
    if (out == nullptr) return std::fprintf(stderr, "usage: controller RUN.csv\n"), 2;
    std::fprintf(out, "t [s],wanted [rad/s],w [rad/s]\n");

    static algest::generated::Motor estimator;
    Controller controller;
    std::mt19937 dice(1);
    std::normal_distribution<double> noise;
    State motor = {0, 0};
    Constants found = data_sheet;
    const int retuned = 2000, end = 4000;   // periods
    double before = 0, after = 0;           // sums of squares over the second before, and the last
    for (int k = 0; k < end; ++k) {
        const double current = motor[0] + 0.005 * noise(dice), speed = motor[1] + 0.1 * noise(dice);
        const Wanted wanted = wanted_at(k * period);
        const double voltage = controller.command(wanted, speed);   // held until the next sample
        const auto e = estimator.step({voltage, current, speed});
        if (k == retuned && e.status == algest::Status::ok) controller.retune(found = {e.R, e.J, e.b, e.Tc});

        std::fprintf(out, "%.3f,%.4f,%.4f\n", k * period, wanted.speed, motor[1]);
        const double error = wanted.speed - motor[1];
        if (k >= retuned - 1000 && k < retuned) before += error * error;
        if (k >= end - 1000) after += error * error;
        motor = advance(motor, voltage);
    }
    std::printf("           data sheet    estimate       truth  unit\n");
    std::printf("R          %10.4g  %10.4g  %10.4g  ohm\n", data_sheet.R, found.R, truth.R);
    std::printf("J          %10.3g  %10.3g  %10.3g  kg.m^2\n", data_sheet.J, found.J, truth.J);
    std::printf("b          %10.3g  %10.3g  %10.3g  N.m.s/rad\n", data_sheet.b, found.b, truth.b);
    std::printf("Tc         %10.3g  %10.3g  %10.3g  N.m\n", data_sheet.Tc, found.Tc, truth.Tc);
    std::printf("rms speed error: %.2f rad/s before, %.2f rad/s after retuning\n", std::sqrt(before / 1000), std::sqrt(after / 1000));
    return std::fclose(out) == 0 ? 0 : 2;
}
