// SPDX-License-Identifier: 0BSD
// The speed as it is measured: with noise of 1 percent of its rms while the drive is identified, coloured by a pole at 0.9.
#pragma once
#include <cmath>
#include <random>

namespace drive_train {

constexpr double speed_noise = 0.23;   ///< rad/s, standard deviation

class Sensor {
public:
    double measured(double omega) {
        constexpr double pole = 0.9;
        noise_ = pole * noise_ + std::sqrt(1.0 - pole * pole) * white();
        return omega + speed_noise * noise_;
    }

private:
    /// Uniform, of variance 1.
    double white() { return std::sqrt(3.0) * (static_cast<double>(random_()) / 2147483648.0 - 1.0); }

    std::mt19937 random_{1};
    double noise_ = 0.0;
};

}  // namespace drive_train
