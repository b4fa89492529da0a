// SPDX-License-Identifier: GPL-3.0-or-later
// Discrete-time identification (004): what the derivatives with respect to z leave of a difference equation, the map between the
// coefficients of q and of z, and iterated sums as exact weights. Everything is an exact number; nothing here knows a model file.
#pragma once
#include <vector>

#include "generator/exact.hpp"

namespace algest::discrete {

using exact::Integer;
using exact::Rational;

/// coefficient * z^power * d^derivative y_z / dz^derivative
struct LeibnizTerm {
    Integer coefficient;
    int power;
    int derivative;
};

/// d^derivatives/dz^derivatives of z^i y_z by the product rule (004, equation 16); highest derivative of y_z first.
std::vector<LeibnizTerm> leibniz_expansion(int i, int derivatives);

/// chi(k), the factor that this leaves at y(k-n+i), times (-1)^derivatives (004, equations 3, 15 and 18): a polynomial in k, lowest power
/// first. It is the same for every i = 0 .. n, and vanishes at k = 0 .. n, where a difference equation would need what was before the first
/// sample, if derivatives > n.
std::vector<Integer> multiplier(int i, int n, int derivatives);

/// Value of a polynomial, lowest power first.
Integer value_at(const std::vector<Integer>& polynomial, int k);

/// A combination of neighbouring samples: entry s multiplies f(k-n+s); entry s of a denominator's column stands at z^s.
using Taps = std::vector<Rational>;

/// Column i of Pi^a, i = 0 .. n (004, equations 6 to 8): what A_i q^i becomes in z by z = (1+q/Omega0)/(1-q/Omega0), expanded. Column 0
/// belongs to the 1 of the denominator.
Taps denominator_in_q(int i, int n, const Rational& omega0);
/// Column i of Pi^b, i = 0 .. numerator: what (1-q/Omega0)^(n-m) B_i q^i becomes in z; entries above m are 0.
Taps numerator_in_q(int i, int n, int m, const Rational& omega0);
/// Column i of Xi_b, i = 0 .. numerator (004, section IV): (z+1)^(m-numerator) z^i; the zeros that are preset lie at -1. Entries above m are 0.
Taps numerator_in_z(int i, int n, int m, int numerator);
/// z^i, i = 0 .. n.
Taps denominator_in_z(int i, int n);

/// What is applied to the rows again and again: 1/(z-gamma), 1 for sums (004, section V, item 1).
/// Entry d is what level l gives to the equation of d samples ago, times a positive number that is the same for all d: 0 for d < l.
/// Level 0 is the equation itself. Cost: count products of long integers.
std::vector<Integer> level(int l, const Rational& gamma, int count);

/// The impulse response of numerator(z^-1)/denominator(z^-1) from rest, times a positive number: entry d for d = 0 .. count-1.
/// denominator[0] != 0.
std::vector<Integer> impulse_response(const std::vector<Rational>& numerator, const std::vector<Rational>& denominator, int count);
std::vector<Integer> convolved(const std::vector<Integer>& a, const std::vector<Integer>& b);

/// Weights of the samples f(0) .. f(intervals), oldest first, in  sum_k by_age[intervals-k] chi(k) sum_s taps[s] f(k-n+s); what would be
/// before f(0) counts as 0. Cost: intervals * taps products of long integers.
std::vector<Integer> weights(const std::vector<Integer>& chi, const std::vector<Integer>& by_age, const std::vector<Integer>& taps, int intervals);

}  // namespace algest::discrete
