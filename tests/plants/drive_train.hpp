// SPDX-License-Identifier: GPL-3.0-or-later
// The drive train of 004 as errata.md sets it up: square wave, window, levels; its model with the choices open, its poles, and the noise.
#pragma once
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

#include "algest/transfer_function.hpp"
#include "examples/drive_train/plant.hpp"
#include "lab/discrete_system.hpp"
#include "tests/plants/estimates.hpp"

namespace algest::plants {

constexpr double drive_train_end = 1.35;   ///< s

/// Sampling times of tables (10) and (11), s; as texts, so that a model reads them exactly.
inline const std::vector<std::string> drive_train_periods = {"0.01", "0.005", "0.002", "0.001", "0.0005"};

struct DriveTrainChoice {
    std::string domain = "q";
    int numerator = 4;
    std::string period = "0.01";
    std::string solve = "square";
    std::string more = "";        ///< further lines of [discrete]
};

inline std::string drive_train_model(const DriveTrainChoice& choice) {
    return fmt::format(R"(format = 1
name = "drive_train"
[sampling]
period = {}
window = 1.35
[signals]
u = {{ unit = "V" }}
omega = {{ unit = "rad/s" }}
[discrete]
domain = "{}"
output = "omega"
n = 5
m = 4
numerator = {}
skip = 7
extra = 10
{}
[estimator]
functional = "discrete"
solve = "{}"
)",
                       choice.period, choice.domain, choice.numerator, choice.more, choice.solve);
}

/// Samples of u [V] and omega [rad/s], both ends of [0, 1.35 s] included.
struct DriveTrainRun {
    std::vector<double> u, omega;
};

/// +-1, period 1 s, the first half +1.
inline double square_wave(int k, double period) {
    const int in_second = static_cast<int>(std::lround(1.0 / period));
    return k % in_second < in_second / 2 ? 1.0 : -1.0;
}

/// voltage(k): held from sample k on.
template <class Voltage>
DriveTrainRun drive_train_run(double period, Voltage voltage, const drive_train::Plant::State& start = {}) {
    drive_train::Plant plant(period, {}, start);
    DriveTrainRun out;
    for (int k = 0; k <= static_cast<int>(std::lround(drive_train_end / period)); ++k) {
        out.u.push_back(voltage(k));
        out.omega.push_back(plant.omega());
        plant.advance(out.u.back());
    }
    return out;
}

inline DriveTrainRun drive_train_run(double period, const drive_train::Plant::State& start = {}) {
    return drive_train_run(period, [&](int k) { return square_wave(k, period); }, start);
}

/// Colours white noise by a pole at 0.9, to 1 percent of the speed's rms.
inline void add_drive_train_noise(DriveTrainRun& run, unsigned seed) {
    constexpr double pole = 0.9, share = 0.01;
    double square = 0.0;
    for (const double w : run.omega) square += w * w;
    const double size = share * std::sqrt(square / static_cast<double>(run.omega.size()));
    std::mt19937_64 random(seed);
    std::normal_distribution<double> white;
    double noise = white(random);
    for (double& w : run.omega) {
        w += size * noise;
        noise = pole * noise + std::sqrt(1.0 - pole * pole) * white(random);
    }
}

struct DriveTrainEstimate {
    Status status;
    double condition;
    std::vector<double> unknowns;
};

/// Read when the window first fills, at 1.35 s.
inline DriveTrainEstimate at_the_end(const plan::Plan& plan, const DriveTrainRun& run) {
    REQUIRE(plan.inputs[0].name == "u");
    lab::HostEstimator<double> estimator(plan);
    for (std::size_t k = 0; k < run.u.size(); ++k) estimator.push(std::vector<double>{run.u[k], run.omega[k]}.data());
    const Status status = estimator.estimate();
    return {status, estimator.condition(), estimator.parameters()};
}

/// Relative distances of the poles of G(s) to the nearest of the estimated ones: of 8.1, of the pair at 12.4, of the pair at 27.7 rad/s.
inline std::vector<double> pole_errors(const plan::Plan& plan, const std::vector<double>& unknowns) {
    const drive_train::Constants c;
    const auto pair = [](double omega, double xi) { return omega * std::complex<double>(-xi, std::sqrt(1.0 - xi * xi)); };
    const auto system = lab::discrete_system(plan, unknowns);
    REQUIRE(system);
    std::vector<double> out;
    for (const std::complex<double> truth : {std::complex<double>(-c.corner), pair(c.omega_1, c.xi_1), pair(c.omega_2, c.xi_2)}) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::complex<double> s : system->poles_s) nearest = std::min({nearest, std::abs(s - truth), std::abs(std::conj(s) - truth)});
        out.push_back(nearest / std::abs(truth));
    }
    return out;
}

}  // namespace algest::plants
