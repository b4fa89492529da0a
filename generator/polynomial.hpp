// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials with exact coefficients in a fixed list of variables, in an order of our own (GiNaC's changes from run to run).
#pragma once
#include <map>
#include <string>
#include <vector>

#include "generator/exact.hpp"
#include "generator/tape.hpp"

namespace algest {

/// Exponents of the variables, in the order of their list.
using Exponents = std::vector<int>;

/// Terms, the one with the highest powers of the first variable first. No term has coefficient 0; empty is zero.
using Polynomial = std::map<Exponents, exact::Rational, std::greater<>>;

Polynomial constant(const exact::Rational& value, std::size_t variables);
Polynomial sum(const Polynomial& a, const Polynomial& b);
Polynomial product(const Polynomial& a, const Polynomial& b);
Polynomial scaled(const Polynomial& a, const exact::Rational& factor);
int total_degree(const Polynomial& a);
bool is_constant(const Polynomial& a);
/// True if variable k occurs.
bool uses(const Polynomial& a, std::size_t k);
/// At a point, a value for each variable.
exact::Rational value_at(const Polynomial& a, const std::vector<exact::Rational>& point);
/// d/d(variable k).
Polynomial derivative(const Polynomial& a, std::size_t k);
/// The rational c for which a / c has coprime integer coefficients, the first positive. a: a map to coefficients, not empty.
template <class Terms>
exact::Rational content(const Terms& a) {
    exact::Integer numerators = 0;
    exact::Integer denominators = 1;
    for (const auto& [key, c] : a) {
        numerators = cln::gcd(numerators, cln::numerator(c));
        denominators = cln::lcm(denominators, cln::denominator(c));
    }
    const exact::Rational size = exact::Rational(numerators) / denominators;
    return cln::minusp(a.begin()->second) ? -size : size;
}

/// "a1*R - 3*L^2" in the names of the variables; "0" for zero.
std::string text(const Polynomial& a, const std::vector<std::string>& names);
std::string latex(const Polynomial& a, const std::vector<std::string>& names);

/// A quotient of two polynomials; the denominator is not zero.
struct Quotient {
    Polynomial numerator;
    Polynomial denominator;
};
/// Removes common powers of variables and the content of the denominator.
Quotient reduced(Quotient q);
std::string text(const Quotient& q, const std::vector<std::string>& names);
std::string latex(const Quotient& q, const std::vector<std::string>& names);

}  // namespace algest
