// SPDX-License-Identifier: GPL-3.0-or-later
// Which formulas of signals are the same: sin(u + y) and sin(y + u), sin(2*u) and sin(u + u), abs(-u) and abs(u).
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "generator/model.hpp"
#include "generator/polynomial.hpp"

namespace algest::equation {

/// A formula is factor * (the form of this number). Two formulas with one number differ by their factors alone.
struct NormalForm {
    int number;
    exact::Rational factor;   ///< 0: the formula is zero
};

/// Brings formulas of signals and constants to an exact normal form: multiplied out to a sum of products of whole powers, over
/// signals, derivatives, functions of normal forms and sums below a fraction bar. A formula that would have more than
/// `most_terms` terms is the same as its own text alone.
class NormalForms {
public:
    explicit NormalForms(const model::Model& model) : model_(model) {}

    /// The formula has no parameters in it. Cost: its terms, multiplied out.
    NormalForm of(const formula::Formula& f);

    static constexpr std::size_t most_terms = 2000;

private:
    /// (number of a factor, its power), sorted.
    using Monomial = std::vector<std::pair<int, int>>;
    using Sum = std::map<Monomial, exact::Rational>;
    struct TooLarge {};

    Sum sum_of(const formula::Formula& f);
    void add(Sum& out, const formula::Formula& f, const exact::Rational& factor);
    Sum power(const formula::Formula& f);
    Sum call(const formula::Formula& f);
    /// 1 / f^power
    Sum reciprocal(const formula::Formula& f, int power);
    NormalForm numbered(const Sum& sum);
    /// "2*#7"
    std::string argument(const formula::Formula& f);
    Sum factor(const std::string& key, const exact::Rational& coefficient = 1);

    const model::Model& model_;
    std::map<std::string, int> factors_;   // by a text that says all of it
    std::map<Sum, int> sums_;
};

}  // namespace algest::equation
