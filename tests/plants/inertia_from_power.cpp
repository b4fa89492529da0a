// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 2 of issue 6: the inertia of the motor of Delpoux, Bodson, Floquet 2014 (section 4.2) from the power of an acceleration from 30 to
// 38 rad/s, beside equation (54), which draws the friction's power as a straight line and leaves the inductance out.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

#include "examples/sensorless_motor/equilibrium.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

const sensorless_motor::Motor motor;
constexpr double J = 3.18e-4, omega_1 = 30, omega_2 = 38, c = 400, before = 0.3, after = 0.3;
constexpr double ramp = (omega_2 * omega_2 - omega_1 * omega_1) / (2 * c);   // 0.68 s
constexpr double T = 1e-3;

/// Equation (52).
double command(double t) { return t < before ? omega_1 : t < before + ramp ? std::sqrt(omega_1 * omega_1 + 2 * c * (t - before)) : omega_2; }

/// Currents in the frame of the command, speed, n_p (theta_r - theta): equation (7), forward rotation.
using State = std::array<double, 4>;

struct Run {
    std::vector<double> t, i_f, i_g, omega_r;
    double v_f;
};

/// Constant voltage in the frame of the command, from the equilibrium at 30 rad/s.
Run accelerate(double v_f) {
    const auto start = sensorless_motor::equilibrium(motor, omega_1, v_f, 0);
    const double sine = (v_f - motor.R * start.i_f + motor.L * motor.n_p * omega_1 * start.i_g) / (motor.K * omega_1);
    const double cosine = (-motor.R * start.i_g - motor.L * motor.n_p * omega_1 * start.i_f) / (motor.K * omega_1);
    State x = {start.i_f, start.i_g, omega_1, std::atan2(sine, cosine)};
    const auto motion = [&](const State& s, State& rate, double t) {
        const auto [i_f, i_g, omega, delta] = s;
        const double turn = motor.L * motor.n_p * command(t);
        rate = {(v_f - motor.R * i_f - motor.K * omega * std::sin(delta) + turn * i_g) / motor.L, (-motor.R * i_g - motor.K * omega * std::cos(delta) - turn * i_f) / motor.L,
                (motor.K * (i_f * std::sin(delta) + i_g * std::cos(delta)) - motor.f_v * omega - motor.C_r) / J, motor.n_p * (command(t) - omega)};
    };
    boost::numeric::odeint::runge_kutta4<State> stepper;
    Run out{{}, {}, {}, {}, v_f};
    constexpr int fine = 50;   // 20 us: the fastest mode turns with n_p omega = 2000 rad/s
    const int samples = static_cast<int>(std::lround((before + ramp + after) / T));
    for (int k = 0; k <= samples; ++k) {
        out.t.push_back(k * T);
        out.i_f.push_back(x[0]);
        out.i_g.push_back(x[1]);
        out.omega_r.push_back(command(k * T));
        for (int i = 0; i < fine; ++i) stepper.do_step(motion, x, k * T + i * T / fine, T / fine);
    }
    return out;
}

/// Equations (53) and (54): mean of (P_em - P_f)/c over the acceleration, P_f from the means before and after it.
double by_interpolation(const Run& run) {
    const auto mean = [&](double from, double to, const auto& value) {
        double sum = 0;
        int count = 0;
        for (std::size_t k = 0; k < run.t.size(); ++k) {
            if (run.t[k] < from - T / 2 || run.t[k] > to + T / 2) continue;
            sum += value(k);
            ++count;
        }
        return sum / count;
    };
    const auto power = [&](std::size_t k) { return run.v_f * run.i_f[k] - motor.R * (run.i_f[k] * run.i_f[k] + run.i_g[k] * run.i_g[k]); };
    const double first = mean(0, before, power);
    const double second = mean(before + ramp, before + ramp + after, power);
    return mean(before, before + ramp, [&](std::size_t k) { return power(k) - first - (second - first) * (run.t[k] - before) / ramp; }) / c;
}

/// The estimate at the end of the acceleration: the window is its length. Phase quantities, as measured.
double by_model(const Run& run) {
    const plan::Plan plan = plan_of(committed_model("pmsm_inertia"));
    std::vector<std::vector<double>> samples;
    double angle = 0;
    for (std::size_t k = 0; k < run.t.size() && run.t[k] < before + ramp + T / 2; ++k) {
        const double co = std::cos(motor.n_p * angle), si = std::sin(motor.n_p * angle);
        samples.push_back({run.v_f * co, run.v_f * si, run.i_f[k] * co - run.i_g[k] * si, run.i_f[k] * si + run.i_g[k] * co, run.omega_r[k]});
        angle += T * run.omega_r[k];
    }
    const Estimate last = estimates(plan, samples).back();
    REQUIRE(last.status == Status::ok);
    return last.parameters[0];
}

}  // namespace

TEST_CASE("inertia from power: the model's friction and the inductance's term, beside the interpolation (54)") {
    for (const double V : {22.0, 24.0, 26.0}) {
        const Run run = accelerate(V);
        const double better = relative_error(by_model(run), J);
        const double interpolated = relative_error(by_interpolation(run), J);
        WARN(fmt::format("relative error of the inertia at {} V: {:.2g}; by equation (54) {:.2g}", V, better, interpolated));
        CHECK(better < 0.02);
        CHECK(interpolated < 0.10);
        CHECK(interpolated > better);
    }
}
