// SPDX-License-Identifier: 0BSD
// Extended Luenberger observer of one axis: position, velocity, and the force that the model does not know.
#pragma once
#include <cmath>

namespace magnetic_bearing {

/// A mass under a known force, held over each period, and an unknown one that is taken for constant. All three poles of the error
/// lie at exp(-rate period): the gains are those of the critically damped g-h-k filter (Brookner, Tracking and Kalman Filtering
/// Made Easy, 1998).
class PerturbationObserver {
public:
    /// mass [kg], period [s], rate [rad/s].
    PerturbationObserver(double mass, double period, double rate) : mass_(mass), period_(period) {
        const double pole = std::exp(-rate * period);
        position_gain_ = 1.0 - pole * pole * pole;
        velocity_gain_ = 1.5 * (1.0 - pole * pole) * (1.0 - pole) / period;
        perturbation_gain_ = mass * (1.0 - pole) * (1.0 - pole) * (1.0 - pole) / (period * period);
    }

    /// Takes the position [m] as measured now.
    void correct(double measured) {
        const double surprise = measured - position_;
        position_ += position_gain_ * surprise;
        velocity_ += velocity_gain_ * surprise;
        perturbation_ += perturbation_gain_ * surprise;
    }

    /// Goes on to the next sample, under this force [N] besides the perturbation.
    void predict(double force) {
        const double acceleration = (force + perturbation_) / mass_;
        position_ += period_ * (velocity_ + 0.5 * period_ * acceleration);
        velocity_ += period_ * acceleration;
    }

    double position() const { return position_; }          ///< m
    double velocity() const { return velocity_; }          ///< m/s
    double perturbation() const { return perturbation_; }  ///< N

private:
    double mass_, period_;
    double position_gain_, velocity_gain_, perturbation_gain_;
    double position_ = 0.0, velocity_ = 0.0, perturbation_ = 0.0;
};

}  // namespace magnetic_bearing
