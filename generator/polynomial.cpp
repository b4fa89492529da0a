// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/polynomial.hpp"

#include <algorithm>
#include <numeric>

#include "generator/formula.hpp"

namespace algest {

using exact::Rational;

Polynomial constant(const Rational& value, std::size_t variables) {
    Polynomial out;
    if (!cln::zerop(value)) out.emplace(Exponents(variables, 0), value);
    return out;
}

Polynomial sum(const Polynomial& a, const Polynomial& b) {
    Polynomial out = a;
    for (const auto& [exponents, coefficient] : b) {
        Rational& c = out[exponents];
        c = c + coefficient;
        if (cln::zerop(c)) out.erase(exponents);
    }
    return out;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
    Polynomial out;
    for (const auto& [x, c] : a) {
        for (const auto& [y, d] : b) {
            Exponents e = x;
            for (std::size_t k = 0; k < e.size(); ++k) e[k] += y[k];
            Rational& sum = out[e];
            sum = sum + c * d;
        }
    }
    for (auto at = out.begin(); at != out.end();) at = cln::zerop(at->second) ? out.erase(at) : std::next(at);
    return out;
}

Polynomial scaled(const Polynomial& a, const Rational& factor) {
    Polynomial out;
    if (cln::zerop(factor)) return out;
    for (const auto& [exponents, coefficient] : a) out.emplace(exponents, coefficient * factor);
    return out;
}

int total_degree(const Polynomial& a) {
    int degree = 0;
    for (const auto& [exponents, c] : a) degree = std::max(degree, std::accumulate(exponents.begin(), exponents.end(), 0));
    return degree;
}

bool is_constant(const Polynomial& a) { return total_degree(a) == 0; }

bool uses(const Polynomial& a, std::size_t k) {
    return std::any_of(a.begin(), a.end(), [&](const auto& term) { return term.first[k] != 0; });
}

namespace {

/// How products, powers, fractions and names are spelt.
struct Spelling {
    bool latex;
    std::string name(const std::string& n) const { return latex ? formula::latex_name(n) : n; }
    std::string power(const std::string& n, int e) const {
        if (e == 1) return name(n);
        return latex ? "{" + name(n) + "}^{" + std::to_string(e) + "}" : n + "^" + std::to_string(e);
    }
    std::string number(const Rational& positive) const {
        return latex ? exact::latex(positive) : exact::text(positive);
    }
};

std::string spelt(const Polynomial& a, const std::vector<std::string>& names, const Spelling& spelling) {
    if (a.empty()) return "0";
    std::string out;
    for (const auto& [exponents, c] : a) {
        const bool negative = cln::minusp(c);
        const Rational size = cln::abs(c);
        std::string factors;
        for (std::size_t k = 0; k < exponents.size(); ++k) {
            if (exponents[k] != 0) factors += (factors.empty() ? "" : spelling.latex ? "\\," : "*") + spelling.power(names[k], exponents[k]);
        }
        std::string term = factors;
        if (factors.empty()) term = spelling.number(size);
        else if (size != 1) term = spelling.number(size) + (spelling.latex ? "\\," : "*") + factors;
        if (out.empty()) out = negative ? "-" + term : term;
        else out += (negative ? " - " : " + ") + term;
    }
    return out;
}

std::string spelt(const Quotient& q, const std::vector<std::string>& names, const Spelling& spelling) {
    const std::string above = spelt(q.numerator, names, spelling);
    if (is_constant(q.denominator) && q.denominator.begin()->second == 1) return above;
    const std::string below = spelt(q.denominator, names, spelling);
    if (spelling.latex) return "\\frac{" + above + "}{" + below + "}";
    const bool plain_above = q.numerator.size() <= 1;
    const bool plain_below = below.find_first_of("*+- /") == std::string::npos;
    return (plain_above ? above : "(" + above + ")") + "/" + (plain_below ? below : "(" + below + ")");
}

}  // namespace

Rational value_at(const Polynomial& a, const std::vector<Rational>& point) {
    Rational out = 0;
    for (const auto& [exponents, coefficient] : a) {
        Rational term = coefficient;
        for (std::size_t k = 0; k < exponents.size(); ++k) if (exponents[k] != 0) term = term * exact::power(point[k], exponents[k]);
        out = out + term;
    }
    return out;
}

Polynomial derivative(const Polynomial& a, std::size_t k) {
    Polynomial out;
    for (const auto& [exponents, coefficient] : a) {
        if (exponents[k] == 0) continue;
        Exponents lowered = exponents;
        --lowered[k];
        out.emplace(lowered, coefficient * exponents[k]);
    }
    return out;
}

std::string text(const Polynomial& a, const std::vector<std::string>& names) { return spelt(a, names, Spelling{false}); }
std::string latex(const Polynomial& a, const std::vector<std::string>& names) { return spelt(a, names, Spelling{true}); }
std::string text(const Quotient& q, const std::vector<std::string>& names) { return spelt(q, names, Spelling{false}); }
std::string latex(const Quotient& q, const std::vector<std::string>& names) { return spelt(q, names, Spelling{true}); }

Quotient reduced(Quotient q) {
    if (q.numerator.empty()) return {q.numerator, constant(1, q.denominator.begin()->first.size())};
    const std::size_t variables = q.denominator.begin()->first.size();
    Exponents common(variables, 1000);
    for (const Polynomial* side : {&q.numerator, &q.denominator}) {
        for (const auto& [exponents, c] : *side) {
            for (std::size_t k = 0; k < variables; ++k) common[k] = std::min(common[k], exponents[k]);
        }
    }
    const Rational scale = 1 / content(q.denominator);
    for (Polynomial* side : {&q.numerator, &q.denominator}) {
        Polynomial lowered;
        for (const auto& [exponents, c] : *side) {
            Exponents e = exponents;
            for (std::size_t k = 0; k < variables; ++k) e[k] -= common[k];
            lowered.emplace(e, c * scale);
        }
        *side = lowered;
    }
    return q;
}

}  // namespace algest
