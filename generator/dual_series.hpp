// SPDX-License-Identifier: GPL-3.0-or-later
// Power series whose coefficients carry gradients, modulo a prime: coefficient k of a function from those of its argument.
#pragma once
#include <vector>

#include "generator/modular.hpp"

namespace algest::modular {

/// A number and how it moves with each unknown.
struct Dual {
    Number value;
    Vector gradient;

    Dual() = default;
    Dual(Number v, std::size_t unknowns) : value(v), gradient(unknowns) {}
};

inline Dual operator+(Dual a, const Dual& b) {
    a.value = a.value + b.value;
    for (std::size_t k = 0; k < a.gradient.size(); ++k) a.gradient[k] = a.gradient[k] + b.gradient[k];
    return a;
}
inline Dual operator*(Dual a, Number factor) {
    a.value = a.value * factor;
    for (Number& g : a.gradient) g = g * factor;
    return a;
}
inline Dual operator-(const Dual& a, const Dual& b) { return a + b * Number(-1); }
inline Dual operator*(const Dual& a, const Dual& b) {
    Dual out(a.value * b.value, a.gradient.size());
    for (std::size_t k = 0; k < out.gradient.size(); ++k) out.gradient[k] = a.gradient[k] * b.value + a.value * b.gradient[k];
    return out;
}
/// b.value != 0
inline Dual operator/(const Dual& a, const Dual& b) {
    const Number below = b.value.inverse();
    Dual out(a.value * below, a.gradient.size());
    for (std::size_t k = 0; k < out.gradient.size(); ++k) out.gradient[k] = (a.gradient[k] - out.value * b.gradient[k]) * below;
    return out;
}

/// Lowest power first.
using Series = std::vector<Dual>;

/// f(argument) where f is `value` and its slope is what `slope` makes of that.
template <class Slope>
Dual start(Number value, const Dual& argument, Slope slope) {
    Dual out = argument * slope(value);
    out.value = value;
    return out;
}

/// Coefficient k of a*b; both have k + 1 coefficients.
inline Dual product(const Series& a, const Series& b, std::size_t k) {
    Dual out = a[0] * b[k];
    for (std::size_t j = 1; j <= k; ++j) out = out + a[j] * b[k - j];
    return out;
}

/// Of 1/a; `inverse` has k coefficients.
inline Dual reciprocal(const Series& a, const Series& inverse, std::size_t k) {
    Dual out(k == 0 ? 1 : 0, a[0].gradient.size());
    for (std::size_t j = 1; j <= k; ++j) out = out - a[j] * inverse[k - j];
    return out / a[0];
}

/// k >= 1: of the integral of outer * a'; `outer` has k coefficients. exp(a) is its own outer.
inline Dual integrated(const Series& a, const Series& outer, std::size_t k) {
    Dual out(0, a[0].gradient.size());
    for (std::size_t j = 1; j <= k; ++j) out = out + a[j] * outer[k - j] * Number(static_cast<std::int64_t>(j));
    return out * Number(static_cast<std::int64_t>(k)).inverse();
}

/// k >= 1: of log(a); `known` has k coefficients.
inline Dual logarithm(const Series& a, const Series& known, std::size_t k) {
    Dual out = a[k] * Number(static_cast<std::int64_t>(k));
    for (std::size_t j = 1; j < k; ++j) out = out - known[j] * a[k - j] * Number(static_cast<std::int64_t>(j));
    return out * Number(static_cast<std::int64_t>(k)).inverse() / a[0];
}

/// k >= 1: of sqrt(a); `known` has k coefficients.
inline Dual root(const Series& a, const Series& known, std::size_t k) {
    Dual out = a[k];
    for (std::size_t j = 1; j < k; ++j) out = out - known[j] * known[k - j];
    return out / (known[0] * Number(2));
}

}  // namespace algest::modular
