// SPDX-License-Identifier: GPL-3.0-or-later
// The parabola filter of 001 (section 2, equal spacing) as a linear filter, exactly. With states v (value) and s (T times the derivative),
// equations (5) to (8) are
//     17 v_k = 12 v_(k-1) + 8 s_(k-1) + y_k + 4 y_(k+1),     17 s_k = -10 v_(k-1) - s_(k-1) + 2 y_k + 8 y_(k+1)
// so that, one sample late, V/Y = (z+1)(4z+1)/d(z) and S/Y = 2(z-1)(4z+1)/d(z), d(z) = 17 z^2 - 11 z + 4.
#pragma once
#include <complex>
#include <vector>

#include "generator/exact.hpp"

namespace algest::parabola {

enum class Output { value, slope };   ///< v, and s = T times the derivative

/// Response to an impulse at sample 0: entry m is the output that is known once sample m is. Cost: 4 operations an entry.
std::vector<exact::Rational> impulse_response(Output output, int length);

/// Sum of the squares of the whole impulse response: the variance that white noise of variance 1 leaves. 0.319 = 0.564^2 for the slope.
exact::Rational noise_power(Output output);

/// Samples after which the impulse response is below 1e-7 of its largest entry.
constexpr int memory = 24;

/// At sample k, in terms of the samples around it: its one sample of delay taken away. 0 < frequency_times_period <= 1/2.
/// The slope's is to be compared with i 2 pi frequency_times_period.
std::complex<double> frequency_response(Output output, double frequency_times_period);

}  // namespace algest::parabola
