// SPDX-License-Identifier: MIT-0
// What a discrete-time estimator's unknowns say (004): coefficients of z from those of q and back, poles and zeros, and the poles of the
// continuous-time machine behind a hold. For controllers and for the host; no heap, loops of fixed length.
//   G(z) = (z+1)^(m-numerator) (b0 + .. + b_numerator z^numerator) / (a0 + .. + a_n z^n), a_n = 1
//   G(q) = (1-q/Omega0)^(n-m) (B0 + .. + B_numerator q^numerator) / (1 + A1 q + .. + An q^n), Omega0 = 2/period, q = Omega0 (z-1)/(z+1)
#pragma once
#include <cmath>
#include <complex>

namespace algest {

/// Largest degree of a polynomial here.
constexpr int largest_degree = 12;

/// out[0 .. degree]: coefficients of sum_i c[i] (x + first)^i (sign x + 1)^(degree-i), lowest power first; out must not be c.
/// first = -1, sign = 1: from p = q/Omega0 to z; first = 1, sign = -1: from z to p; each times 2^degree undoes the other.
/// Cost: degree^3 operations. degree <= largest_degree.
template <class S>
inline void substitute_bilinear(const S* c, int degree, S first, S sign, S* out) noexcept {
    S power[largest_degree + 1] = {S(1)};   // (sign x + 1)^(degree-i)
    for (int k = 0; k <= degree; ++k) out[k] = S(0);
    out[0] = c[degree];
    for (int i = degree - 1; i >= 0; --i) {
        const int reached = degree - i;
        for (int k = reached; k > 0; --k) {
            out[k] = out[k - 1] + first * out[k];
            power[k] = power[k] + sign * power[k - 1];
        }
        out[0] *= first;
        for (int k = 0; k <= reached; ++k) out[k] += c[i] * power[k];
    }
}

/// Orders of a transfer function as above; n >= m >= numerator.
struct TransferOrders {
    int n;
    int m;
    int numerator;
};

/// (6) and (7): a (n+1, a[n] = 1) and b (numerator+1) from A (n: A1 .. An) and B (numerator+1). Cost: n^3 operations.
/// Not finite where a pole of G(q) lies at Omega0.
template <class S>
inline void z_from_q(TransferOrders orders, S period, const S* A, const S* B, S* a, S* b) noexcept {
    const S omega0 = S(2) / period;
    S scaled[largest_degree + 1] = {S(1)};
    S power = S(1);
    for (int i = 1; i <= orders.n; ++i) scaled[i] = A[i - 1] * (power *= omega0);
    substitute_bilinear(scaled, orders.n, S(-1), S(1), a);
    power = std::ldexp(S(1), orders.n - orders.m);
    for (int i = 0; i <= orders.numerator; ++i, power *= omega0) scaled[i] = B[i] * power;
    substitute_bilinear(scaled, orders.numerator, S(-1), S(1), b);
    const S leading = a[orders.n];
    for (int i = 0; i <= orders.n; ++i) a[i] /= leading;
    for (int i = 0; i <= orders.numerator; ++i) b[i] /= leading;
}

/// The other way: A (n) and B (numerator+1) from a (n+1) and b (numerator+1). Cost: n^3 operations. Not finite where a pole of G(z) lies at 1.
template <class S>
inline void q_from_z(TransferOrders orders, S period, const S* a, const S* b, S* A, S* B) noexcept {
    const S omega0 = S(2) / period;
    S in_p[largest_degree + 1];
    substitute_bilinear(a, orders.n, S(1), S(-1), in_p);
    const S constant = in_p[0];
    S power = S(1);
    for (int i = 1; i <= orders.n; ++i) A[i - 1] = in_p[i] / constant / (power *= omega0);
    substitute_bilinear(b, orders.numerator, S(1), S(-1), in_p);
    power = constant / std::ldexp(S(1), orders.m - orders.numerator);
    for (int i = 0; i <= orders.numerator; ++i, power *= omega0) B[i] = in_p[i] / power;
}

/// Steps of polynomial_roots: it converges cubically for distinct roots, after at most some ten steps on the way there.
constexpr int root_steps = 100;

/// All roots of c[0] + c[1] x + .. + c[degree] x^degree, c[degree] != 0, by Aberth's iteration from points on a circle of the roots'
/// geometric mean. Multiple roots are found to the digits that rounding leaves them. Not finite where a coefficient is not.
/// Cost: root_steps * degree^2 complex divisions. degree <= largest_degree.
template <class S>
inline void polynomial_roots(const S* c, int degree, std::complex<S>* roots) noexcept {
    int zeros = 0;
    while (zeros < degree && c[zeros] == S(0)) ++zeros;
    for (int k = 0; k < zeros; ++k) roots[k] = std::complex<S>(0);
    const int n = degree - zeros;
    if (n == 0) return;
    const S radius = std::pow(std::abs(c[zeros] / c[degree]), S(1) / S(n));
    std::complex<S>* x = roots + zeros;
    // Not symmetric about the real axis, or a pair could not leave it.
    for (int k = 0; k < n; ++k) x[k] = radius * std::polar(S(1), S(6.2831853) * S(k) / S(n) + S(0.4));   // polar() takes no radius that is no number
    for (int step = 0; step < root_steps; ++step) {
        for (int k = 0; k < n; ++k) {
            std::complex<S> value = c[degree];
            std::complex<S> slope = S(0);
            for (int i = degree - 1; i >= zeros; --i) {
                slope = slope * x[k] + value;
                value = value * x[k] + c[i];
            }
            if (value == std::complex<S>(0)) continue;
            std::complex<S> others = S(0);
            for (int j = 0; j < n; ++j) {
                if (j != k && x[j] != x[k]) others += S(1) / (x[k] - x[j]);
            }
            const std::complex<S> change = S(1) / (slope / value - others);
            if (std::isfinite(change.real()) && std::isfinite(change.imag())) x[k] -= change;
        }
    }
}

/// s of z = exp(s period): the pole of the continuous-time machine behind a hold. period in s, s in rad/s; the frequencies up to pi/period.
template <class S>
inline std::complex<S> continuous_from_z(std::complex<S> z, S period) noexcept {
    return std::log(z) / period;
}

/// The same from a pole of G(q): q = Omega0 tanh(s/Omega0), without the digits that z loses near 1.
template <class S>
inline std::complex<S> continuous_from_q(std::complex<S> q, S period) noexcept {
    return std::atanh(q * (period / S(2))) * (S(2) / period);
}

/// Poles of G(q) as continuous-time ones: A (n: A1 .. An) -> poles (n) in rad/s. Cost: polynomial_roots.
template <class S>
inline void continuous_poles_of_q(const S* A, int n, S period, std::complex<S>* poles) noexcept {
    S c[largest_degree + 1] = {S(1)};
    for (int i = 0; i < n; ++i) c[i + 1] = A[i];
    polynomial_roots(c, n, poles);
    for (int k = 0; k < n; ++k) poles[k] = continuous_from_q(poles[k], period);
}

}  // namespace algest
