// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a fitted machine starts where its model file says that it does.
#pragma once
#include "lab/variant.hpp"

namespace algest::lab {

/// Squared distance of the fitted start of the first recording from the declared one: over all measured signals with `initial`, each in standard deviations of
/// the fit. What a sensor shows is corrected as the variant's effects say: `initial` is the machine's, not the sensor's. 0 where the fit does not begin with
/// the recording, or knows no deviations. Cost: a few evaluations of a formula.
double away_from_declared_start(const Variant& v);

/// True where the effects of v say of some sensor what it shows instead of the truth.
bool corrects_a_sensor(const Variant& v);

}  // namespace algest::lab
