// SPDX-License-Identifier: 0BSD
// 1.35 s of a square wave on the motor, and what the two generated estimators make of it: with all four zeros, and with the zeros preset.
#pragma once
#include <drive_train/drive_train.hpp>
#include <drive_train_zeros/drive_train_zeros.hpp>

#include <vector>

#include "plant.hpp"
#include "sensor.hpp"
#include "transfer.hpp"

namespace drive_train {

constexpr double period = 0.01;                 ///< s
constexpr double identification_time = 1.35;    ///< s: the window of both estimators
constexpr int half_wave = 50;                   ///< periods

struct Identification {
    std::vector<double> u;           ///< V
    std::vector<double> measured;    ///< rad/s
    algest::generated::DriveTrain::Estimate preset;
    algest::generated::DriveTrainZeros::Estimate all;
};

inline Identification identify() {
    Plant plant(period);
    Sensor sensor;
    algest::generated::DriveTrain preset;
    algest::generated::DriveTrainZeros all;
    Identification out{};
    for (int k = 0; k <= static_cast<int>(identification_time / period + 0.5); ++k) {
        const double u = k % (2 * half_wave) < half_wave ? 1.0 : -1.0;
        const double omega = sensor.measured(plant.omega());
        out.preset = preset.step({u, omega});
        out.all = all.step({u, omega});
        out.u.push_back(u);
        out.measured.push_back(omega);
        plant.advance(u);
    }
    return out;
}

inline Transfer transfer_of(const algest::generated::DriveTrain::Estimate& e) { return {{e.B0}, {1.0, e.A1, e.A2, e.A3, e.A4, e.A5}, 1}; }
inline Transfer transfer_of(const algest::generated::DriveTrainZeros::Estimate& e) {
    return {{e.B0, e.B1, e.B2, e.B3, e.B4}, {1.0, e.A1, e.A2, e.A3, e.A4, e.A5}, 1};
}

}  // namespace drive_train
