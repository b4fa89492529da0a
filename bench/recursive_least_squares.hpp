// SPDX-License-Identifier: GPL-3.0-or-later
// What a user would take instead: recursive least squares with forgetting on the motor's equations, the derivative of the currents by a
// difference of two samples (Ljung 1999, section 11.2).
#pragma once
#include <Eigen/Dense>

#include "tests/plants/pmsm.hpp"

namespace algest::bench {

class RecursiveLeastSquares {
public:
    /// memory: samples after which a row counts 1/e.
    RecursiveLeastSquares(double period, double n_p, double memory) : period_(period), n_p_(n_p), keep_(1.0 - 1.0 / memory) {}

    /// (i[k+1] - i[k]) / T = v theta_0 - i theta_1 ..., theta = 1/L, R/L, K/L; voltages held from k to k+1, the rest at the middle.
    void push(const plants::PmsmSample& next) {
        const plants::PmsmSample& s = last_;
        const double i_d = 0.5 * (s.i_d + next.i_d), i_q = 0.5 * (s.i_q + next.i_q), omega = 0.5 * (s.omega + next.omega);
        if (started_) {
            update({s.v_d, -i_d, 0.0}, (next.i_d - s.i_d) / period_ - n_p_ * omega * i_q);
            update({s.v_q, -i_q, -omega}, (next.i_q - s.i_q) / period_ + n_p_ * omega * i_d);
            covariance_ /= keep_;
        }
        last_ = next;
        started_ = true;
    }
    double R() const { return theta_[1] / theta_[0]; }
    double L() const { return 1.0 / theta_[0]; }
    double K() const { return theta_[2] / theta_[0]; }

private:
    void update(const Eigen::Vector3d& regressor, double value) {
        const Eigen::Vector3d spread = covariance_ * regressor;
        const Eigen::Vector3d gain = spread / (1.0 + regressor.dot(spread));
        theta_ += gain * (value - regressor.dot(theta_));
        covariance_ -= gain * spread.transpose();
    }

    double period_, n_p_, keep_;
    Eigen::Vector3d theta_ = Eigen::Vector3d(1.0 / 0.03, 5.0 / 0.03, 0.4 / 0.03);   // the initial values of the model file
    Eigen::Matrix3d covariance_ = 1e6 * Eigen::Matrix3d::Identity();
    plants::PmsmSample last_{};
    bool started_ = false;
};

}  // namespace algest::bench
