// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/moment_rounding.hpp"

#include "algest/moments.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

/// Samples of a frame's life and from one frame to the next.
struct Frame {
    int life;
    int block;
};

Frame frame(int intervals, plan::Accumulators accumulators) {
    if (accumulators == plan::Accumulators::float64) return {frame_samples<double>(intervals), moment_block<double>(intervals)};
    return {frame_samples<Twofold<float>>(intervals), moment_block<Twofold<float>>(intervals)};
}

/// sum_j |c_j| x^j.
Rational size_at(const kernel::Coefficients& coefficients, const Rational& x) {
    Rational out = 0;
    for (std::size_t j = coefficients.size(); j-- > 0;) out = out * x + cln::abs(coefficients[j]);
    return out;
}

}  // namespace

Rational rounding_gain(const kernel::WindowPolynomial& polynomial, int intervals, const Rational& step, plan::Scalar scalar, plan::Accumulators accumulators) {
    const Frame f = frame(intervals, accumulators);
    const int additions = f.life + f.block;
    const Rational shift = (f.block - 1) * step;
    const Rational reach = (f.life - 1) * step + shift;
    exact::Integer root;
    cln::isqrt(additions, &root);
    const Rational summed = Rational(additions) / 2 * size_at(polynomial.coefficients, shift) + (9 + root) * size_at(polynomial.coefficients, reach);
    const Rational once = size_at(polynomial.coefficients, intervals * step) + cln::abs(polynomial.oldest) + cln::abs(polynomial.newest);
    const int bits = scalar == plan::Scalar::float64 ? 53 : 24;
    const Rational unit = accumulators == plan::Accumulators::float64 ? exact::power(Rational(2), -53) : additions * exact::power(Rational(2), -48);   // two floats: errors of errors
    return (once + summed * unit * exact::power(Rational(2), bits)) / 8;
}

}  // namespace algest::generator
