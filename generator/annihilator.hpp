// SPDX-License-Identifier: GPL-3.0-or-later
// The annihilator  Pi = d^(kappa+n)/ds^(kappa+n) s^kappa  (000, equation 5), applied with GiNaC to s^i Y(s), made proper by
// s^-(kappa+n+p), and brought back to time as an exact polynomial kernel.
#pragma once
#include <vector>

#include "generator/exact.hpp"

namespace algest::annihilator {

/// Orders of one row. Form 1 (000 theorem 1; 003 theorem 1).
struct Orders {
    int n;
    int kappa;
};

/// coefficient * s^power * d^derivative Y / ds^derivative
struct LeibnizTerm {
    exact::Rational coefficient;
    int power;
    int derivative;
};

/// Pi s^i Y(s), by differentiating kappa+n times with the product rule (000, equations 6 to 8); lowest derivative first.
/// Cost: (kappa+n)^2 polynomial derivatives.
std::vector<LeibnizTerm> leibniz_expansion(int i, Orders orders);

/// True when Pi s^power = 0: powers 0 .. n-1 come from initial conditions, -1 .. -kappa from polynomial perturbations.
bool annihilates(int power, Orders orders);

/// gamma: s^power d^j/ds^j, divided by s^(kappa+n+p), is s^-(gamma+1) d^j/ds^j: the integral of (t-tau)^gamma (-tau)^j / gamma!.
constexpr int time_exponent(int power, int p, Orders orders) { return orders.kappa + orders.n + p - power - 1; }

/// A term after division by s^(kappa+n+p), in time: coefficient (t-tau)^gamma (-tau)^j / gamma!  (000, equation 10).
struct KernelTerm {
    exact::Rational coefficient;   ///< without the 1/gamma!
    int gamma;
    int j;
};

/// The kernel of F_{i,p} (000, equation 3) as the sum of (t-tau)^gamma (-tau)^j / gamma!. p >= 1, i <= n.
std::vector<KernelTerm> kernel_terms(int i, int p, Orders orders);

/// The same at t = 1 as a polynomial in sigma = tau: coefficients, lowest power first, no trailing zeros.
std::vector<exact::Rational> kernel(int i, int p, Orders orders);

}  // namespace algest::annihilator
