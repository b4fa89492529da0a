// SPDX-License-Identifier: GPL-3.0-or-later
// The annihilator  Pi = d^D/ds^D s^kappa  applied with GiNaC to s^i Y(s), made proper by s^-E, and brought back to time as an
// exact polynomial kernel. Two forms tell the rows p of one equation apart:
//   form 1:  D = kappa+n,      E = kappa+n+p   (000, theorem 1; 003, theorem 1): each row integrates once more
//   form 2:  D = kappa+n+p-1,  E = kappa+n+1   (003, theorem 2, there with kappa = 0): each row differentiates once more
#pragma once
#include <vector>

#include "generator/exact.hpp"

namespace algest::annihilator {

/// Orders of the rows of one equation.
struct Orders {
    int n;
    int kappa;
    int form = 1;
};

/// D: how often row p differentiates after s^kappa.
constexpr int derivatives(int p, Orders orders) { return orders.kappa + orders.n + (orders.form == 2 ? p - 1 : 0); }
/// E: the power of s that makes row p proper.
constexpr int division(int p, Orders orders) { return orders.kappa + orders.n + (orders.form == 2 ? 1 : p); }

/// coefficient * s^power * d^derivative Y / ds^derivative
struct LeibnizTerm {
    exact::Rational coefficient;
    int power;
    int derivative;
};

/// Pi s^i Y(s) for row p, by differentiating D times with the product rule (000, equations 6 to 8; 003, equations 12 and 13); lowest
/// derivative first. In form 1 it is the same for every p. Cost: D^2 polynomial derivatives.
std::vector<LeibnizTerm> leibniz_expansion(int i, Orders orders, int p = 1);

/// True when Pi s^power = 0 in every row: powers 0 .. n-1 come from initial conditions, -1 .. -kappa from polynomial perturbations.
bool annihilates(int power, Orders orders);

/// gamma: s^power d^j/ds^j, divided by s^E, is s^-(gamma+1) d^j/ds^j: the integral of (t-tau)^gamma (-tau)^j / gamma!.
constexpr int time_exponent(int power, int p, Orders orders) { return division(p, orders) - power - 1; }

/// A term after division by s^E, in time: coefficient (t-tau)^gamma (-tau)^j / gamma!  (000, equation 10).
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
