// SPDX-License-Identifier: 0BSD
// Ten periods of control are one sample of the estimator: the paper's window of 0.2 s then has 200 samples, not 2000.
#pragma once
#include <pmsm_electrical/pmsm_electrical.hpp>

#include "frames.hpp"

namespace pmsm_drive {

constexpr int periods_per_sample = 10;

/// Currents and speed are taken at the first of the ten periods. A voltage that is held over each is, to the estimator's
/// hold = "zoh", the mean of the ten: one of the ten in its place would be half a sample late.
class EstimatorInput {
public:
    using Sample = algest::generated::PmsmElectrical::Sample;

    /// Takes one control period: measured at its begin [A, rad/s], held over it [V]. True if that completes a sample.
    bool add(const RotorFrame& current, double omega, const RotorFrame& voltage) {
        if (count_ == periods_per_sample) count_ = 0;
        if (count_ == 0) sample_ = {0.0, 0.0, current.d, current.q, omega};
        sample_.v_d += voltage.d / periods_per_sample;
        sample_.v_q += voltage.q / periods_per_sample;
        return ++count_ == periods_per_sample;
    }

    const Sample& sample() const { return sample_; }

private:
    Sample sample_{};
    int count_ = 0;
};

}  // namespace pmsm_drive
