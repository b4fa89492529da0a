// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/window_polynomial.hpp"

#include <algorithm>

namespace algest::kernel {

namespace {

using exact::Rational;

/// p(a + b x).
Coefficients composed(const Coefficients& p, const Rational& a, const Rational& b) {
    Coefficients out;
    for (auto c = p.rbegin(); c != p.rend(); ++c) {   // Horner: out (a + b x) + c
        Coefficients next(out.empty() ? 1 : out.size() + 1, Rational(0));
        for (std::size_t k = 0; k < out.size(); ++k) {
            next[k] = next[k] + out[k] * a;
            next[k + 1] = next[k + 1] + out[k] * b;
        }
        next[0] = next[0] + *c;
        out = next;
    }
    return out;
}

Coefficients combination(const Coefficients& p, const Rational& a, const Coefficients& q, const Rational& b) {
    Coefficients out(std::max(p.size(), q.size()), Rational(0));
    for (std::size_t k = 0; k < p.size(); ++k) out[k] = out[k] + p[k] * a;
    for (std::size_t k = 0; k < q.size(); ++k) out[k] = out[k] + q[k] * b;
    return out;
}

Coefficients derivative(const Coefficients& p) {
    Coefficients out;
    for (std::size_t k = 1; k < p.size(); ++k) out.push_back(p[k] * static_cast<int>(k));
    return out;
}

}  // namespace

exact::Rational coordinate_step(int intervals) {
    Rational step = 1;
    while (step * 2 * intervals > 1) step = step / 2;
    return step;
}

WindowPolynomial window_polynomial(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature, const Rational& step) {
    const Rational h = Rational(1) / intervals;
    const Coefficients area = antiderivative(kernel);
    Coefficients in_sigma;   // the polynomial, of the sample's sigma
    WindowPolynomial out;
    if (hold == plan::Hold::zoh) {   // as held_weights: K(sigma + h) - K(sigma); the newest sample counts nothing
        in_sigma = combination(composed(area, h, 1), 1, area, -1);
        out.oldest = 0;
        out.newest = -value_at(in_sigma, 1);
    } else if (quadrature == plan::Quadrature::exact) {   // as interpolated_weights, with K'' = kernel
        const Coefficients twice = antiderivative(area);
        in_sigma = combination(combination(composed(twice, h, 1), 1, composed(twice, -h, 1), 1), intervals, twice, Rational(-2) * intervals);
        out.oldest = -value_at(twice, -h) * intervals;
        out.newest = value_at(area, 1) - (value_at(twice, 1 + h) - value_at(twice, 1)) * intervals;
    } else {
        in_sigma = combination(kernel, h, {}, 0);
        out.oldest = -value_at(in_sigma, 0) / 2;
        out.newest = -value_at(in_sigma, 1) / 2;
    }
    in_sigma.resize(kernel.size());   // what is beyond cancelled
    out.coefficients = composed(in_sigma, Rational(1) / 2, h / (2 * step));   // sigma = m h = (1 + v h / step) / 2
    return out;
}

GrowingPolynomial growing_polynomial(const Coefficients& kernel, plan::Hold hold) {
    GrowingPolynomial out;
    Coefficients k = kernel;      // its i-th derivative
    Rational factorial = 1;       // (i + 1)!
    for (int i = 0; i < static_cast<int>(kernel.size()); ++i) {
        factorial = factorial * (i + 1);
        // zoh: (K(sigma + h) - K(sigma)) / h in powers of h, K' = kernel. linear: (K(sigma + h) - 2 K(sigma) + K(sigma - h)) / h^2, K'' = kernel
        const bool held = hold == plan::Hold::zoh;
        const Rational inner = held ? 1 / factorial : (i % 2 == 0 ? Rational(2) : Rational(0)) / (factorial * (i + 2));
        Coefficients in_v = composed(k, Rational(1) / 2, Rational(1) / 2);
        in_v.resize(kernel.size(), 0);
        for (Rational& c : in_v) c = c * inner;
        out.by_power.push_back(in_v);
        out.newest.push_back(-value_at(k, 1) / (held ? factorial : factorial * (i + 2)));
        k = derivative(k);
    }
    return out;
}

}  // namespace algest::kernel
