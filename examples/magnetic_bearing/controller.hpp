// SPDX-License-Identifier: 0BSD
// Flatness-based tracking with an observer of the perturbation (Delpoux, Floquet 2015, section 4.2.3): the forces that the
// reference asks for, less what the observer says is there already, and the currents of these forces.
#pragma once
#include "magnets.hpp"
#include "observer.hpp"
#include "reference.hpp"

namespace magnetic_bearing {

class Controller {
public:
    /// period [s]: currents() is called once in each.
    Controller(const Bearing& believed, double period)
        : believed_(believed), y_(believed.mass, period, observer_rate), z_(believed.mass, period, observer_rate) {}

    /// From the next currents on.
    void retune(const PerMagnet& lambda) { believed_.lambda = lambda; }

    /// The currents [A] for the coming period, from the position [m] as measured now.
    PerMagnet currents(const Reference& wanted, const Vector& position) {
        y_.correct(position.y);
        z_.correct(position.z);
        const Vector force{needed(wanted.acceleration.y, wanted.velocity.y, wanted.position.y, y_),
                           needed(wanted.acceleration.z, wanted.velocity.z, wanted.position.z, z_)};
        y_.predict(force.y);
        z_.predict(force.z);
        return magnet_currents(believed_, magnet_forces(force), position);
    }

    /// What pulls at the shaft [N] besides the magnets as they are believed to be.
    Vector perturbation() const { return {y_.perturbation(), z_.perturbation()}; }

private:
    static constexpr double pi = 3.14159265358979323846;
    static constexpr double tracking_rate = 2.0 * pi * 60.0;   // rad/s, a double pole
    static constexpr double observer_rate = 2.0 * pi * 300.0;  // rad/s, a triple pole: well above the shaft's 50 Hz

    double needed(double acceleration, double velocity, double position, const PerturbationObserver& seen) const {
        return believed_.mass * (acceleration + 2.0 * tracking_rate * (velocity - seen.velocity()) +
                                 tracking_rate * tracking_rate * (position - seen.position())) -
               seen.perturbation();
    }

    Bearing believed_;
    PerturbationObserver y_, z_;
};

}  // namespace magnetic_bearing
