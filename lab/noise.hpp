// SPDX-License-Identifier: GPL-3.0-or-later
// The noise of the sensors of a recording: the yardstick of every gap.
#pragma once
#include <vector>

#include "lab/simulate.hpp"

namespace algest::lab {

/// A sensor without any noise is none: noise = 0 declares nothing.
bool declares_noise(const model::Signal& signal);

/// Of a signal that does: its standard deviation, in its unit.
double declared_noise(const model::Signal& signal);

/// True when some scored output declares none: its floor is then a guess, and no bar.
bool guesses_noise(const model::Model& model, const Bench& bench);

/// Standard deviation by signal, in its unit: declared noise and resolution; else, of signals that move, their roughness; else 0.
std::vector<double> noise_by_signal(const model::Model& model, const Bench& bench);

/// Of white noise that would make a signal as rough as it is: rms of its third differences over sqrt(20).
double roughness(const std::vector<double>& x);

}  // namespace algest::lab
