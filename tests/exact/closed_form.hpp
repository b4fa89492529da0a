// SPDX-License-Identifier: GPL-3.0-or-later
// The closed form of the annihilator (errata.md, "Structure"), written out anew: what the derived kernels are compared with.
#pragma once
#include <vector>

#include "generator/exact.hpp"

namespace algest::test {

using exact::Integer;
using exact::Rational;

inline Integer factorial(int n) {
    Integer out = 1;
    for (int k = 2; k <= n; ++k) out = out * k;
    return out;
}

inline Rational binomial(int n, int k) { return Rational(factorial(n)) / factorial(k) / factorial(n - k); }

/// x (x-1) ... (x-count+1): the count-th derivative of s^x is this times s^(x-count), for negative x as well.
inline Integer falling(int x, int count) {
    Integer out = 1;
    for (int k = 0; k < count; ++k) out = out * (x - k);
    return out;
}

/// c_ij = C(kappa+n, j) (kappa+i)! / (i+j-n)!, 0 where i+j < n.
inline Rational c(int i, int j, int n, int kappa) {
    return i + j < n ? Rational(0) : binomial(kappa + n, j) * factorial(kappa + i) / factorial(i + j - n);
}

/// F_{i,p}[t^r](1) = sum_j c_ij (-1)^j (j+r)! / (gamma+j+r+1)!, gamma = kappa + 2n + p - i - j - 1.
inline Rational closed_moment(int i, int p, int n, int kappa, int r) {
    Rational out = 0;
    for (int j = 0; j <= kappa + n; ++j) {
        const int gamma = kappa + 2 * n + p - i - j - 1;
        const Rational c_ij = c(i, j, n, kappa);
        if (!cln::zerop(c_ij)) out = out + (j % 2 == 0 ? 1 : -1) * c_ij * factorial(j + r) / factorial(gamma + j + r + 1);
    }
    return out;
}

/// The integral over [0,1] of polynomial(sigma) sigma^r.
inline Rational moment(const std::vector<Rational>& polynomial, int r) {
    Rational out = 0;
    for (std::size_t k = 0; k < polynomial.size(); ++k) out = out + polynomial[k] / (static_cast<int>(k) + r + 1);
    return out;
}

inline std::vector<Rational> derivative(const std::vector<Rational>& polynomial) {
    std::vector<Rational> out;
    for (std::size_t k = 1; k < polynomial.size(); ++k) out.push_back(polynomial[k] * static_cast<int>(k));
    return out;
}

}  // namespace algest::test
