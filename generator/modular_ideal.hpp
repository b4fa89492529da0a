// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomial equations modulo a prime: a Groebner basis, and how many values a variable takes over the solutions.
#pragma once
#include <map>
#include <optional>
#include <vector>

#include "generator/modular.hpp"
#include "generator/polynomial.hpp"

namespace algest::modular {

/// Degree first, then reverse lexicographic; the largest first.
struct Order {
    bool operator()(const Exponents& a, const Exponents& b) const;
};
using Terms = std::map<Exponents, Number, Order>;

/// A polynomial with exact coefficients, modulo the prime.
Terms from(const Polynomial& p);
/// At a point, a value for each variable.
Number value_at(const Terms& p, const Vector& point);

/// Buchberger's algorithm. Nullopt after `most_pairs` pairs: the equations are too hard for this.
std::optional<std::vector<Terms>> groebner_basis(std::vector<Terms> equations);
constexpr int most_pairs = 4000;   ///< some seconds

/// How many values variable k takes over all (complex) solutions: the degree of its minimal polynomial, made square-free. 0: there is no
/// solution. Nullopt: infinitely many, or more than `most_values`.
std::optional<int> values_of(std::size_t k, const std::vector<Terms>& basis, std::size_t variables);
constexpr int most_values = 64;   ///< far above what a published model has; each takes one more elimination

}  // namespace algest::modular
