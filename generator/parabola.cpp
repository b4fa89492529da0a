// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/parabola.hpp"

#include <numbers>

namespace algest::parabola {

using exact::Rational;

std::vector<Rational> impulse_response(Output output, int length) {
    std::vector<Rational> out;
    Rational v = 0;
    Rational s = 0;
    for (int m = 0; m < length; ++m) {
        const Rational newest = m == 0 ? 1 : 0;
        const Rational here = m == 1 ? 1 : 0;
        const Rational bend = (here + 4 * newest - 5 * v - 9 * s) / 17;
        v = v + s + bend;
        s = s + 2 * bend;
        out.push_back(output == Output::value ? v : s);
    }
    return out;
}

Rational noise_power(Output output) {
    // h_m = 11/17 h_(m-1) - 4/17 h_(m-2) from m = 3 on. With p and q the sums of h_m^2 and h_m h_(m+1) from m = 1 on, squaring the recursion
    // gives p, multiplying it by h_(m-1) gives q.
    const std::vector<Rational> h = impulse_response(output, 3);
    const Rational a = Rational(11) / 17;
    const Rational b = Rational(-4) / 17;
    const Rational h1 = h[1];
    const Rational h2 = h[2];
    // p - h1^2 - h2^2 = a^2 (p - h1^2) + b^2 p + 2 a b q,   q - h1 h2 = a (p - h1^2) + b q
    const Rational q_constant = (h1 * h2 - a * h1 * h1) / (1 - b);
    const Rational q_of_p = a / (1 - b);
    const Rational p = (h1 * h1 + h2 * h2 - a * a * h1 * h1 + 2 * a * b * q_constant) / (1 - a * a - b * b - 2 * a * b * q_of_p);
    return h[0] * h[0] + p;
}

std::complex<double> frequency_response(Output output, double frequency_times_period) {
    const std::complex<double> z = std::polar(1.0, 2.0 * std::numbers::pi * frequency_times_period);
    const std::complex<double> first = output == Output::value ? z + 1.0 : 2.0 * (z - 1.0);
    return z * first * (4.0 * z + 1.0) / (17.0 * z * z - 11.0 * z + 4.0);
}

}  // namespace algest::parabola
