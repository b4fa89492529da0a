// SPDX-License-Identifier: 0BSD
// The numbers that describe a motor: the true ones in the simulated motor, those that are believed in the controller.
#pragma once

namespace pmsm_drive {

/// As identified off line in Delpoux, Floquet 2015, section 4.1.3.
struct Constants {
    double R = 3.01;     ///< ohm
    double L = 9e-3;     ///< H
    double K = 0.27;     ///< N.m/A, of torque and back-EMF
    double J = 3.18e-4;  ///< kg.m^2
    double n_p = 50.0;   ///< pole pairs
};

}  // namespace pmsm_drive
