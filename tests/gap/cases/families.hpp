// SPDX-License-Identifier: GPL-3.0-or-later
// The families of systems, one function each.
#pragma once
#include "system.hpp"

namespace algest::gap {

System dc_motor(const Wish& wish, Random& random, bool angle);
System pmsm(const Wish& wish, Random& random);
System voice_coil(const Wish& wish, Random& random);
System bridge_load(const Wish& wish, Random& random);

System magnetic_bearing(const Wish& wish, Random& random);
System two_mass(const Wish& wish, Random& random);
System mass_spring(const Wish& wish, Random& random, bool speed);
System arm(const Wish& wish, Random& random);
System servo_axis(const Wish& wish, Random& random);
System quarter_car(const Wish& wish, Random& random);

System pump(const Wish& wish, Random& random);
System thermal(const Wish& wish, Random& random, int masses);
System tanks(const Wish& wish, Random& random);

/// An input that plays a table.
std::function<Controller()> play(std::vector<std::vector<double>> table);

}  // namespace algest::gap
