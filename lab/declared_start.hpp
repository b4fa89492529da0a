// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a fitted machine starts where its model file says that it does.
#pragma once
#include <map>
#include <string>

#include "lab/variant.hpp"

namespace algest::lab {

/// By measured signal with `initial` that moves by an equation of its own: the squared distance of the fitted start of the first recording from the declared one, in
/// standard deviations. What a sensor shows is corrected as the variant's effect says: `initial` is the machine's, not the sensor's. Without a signal of which the
/// fit or the correction knows no deviation; empty where the fit does not begin with the recording. Cost: a few evaluations of a formula.
std::map<std::string, double> away_from_declared_start(const Variant& v);

/// True where an effect of v says of such a signal what the truth is behind what its sensor shows.
bool corrects_a_sensor(const Variant& v);

}  // namespace algest::lab
