// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/kernel.hpp"

#include <algorithm>

namespace algest::kernel {

namespace {

using exact::Integer;
using exact::Rational;

/// Weights over one common denominator: weight m is numerators[m] / denominator.
struct Fractions {
    std::vector<Integer> numerators;
    Integer denominator = 1;
};

/// A polynomial of the sample index with integer coefficients over a common denominator.
struct IndexPolynomial {
    std::vector<Integer> coefficients;   ///< lowest power first
    Integer denominator = 1;
};

/// p(m/M) * scale as a polynomial in the index m.
IndexPolynomial in_index(const Coefficients& p, int intervals, const Rational& scale) {
    IndexPolynomial out;
    std::vector<Rational> coefficients;
    Rational power = scale;
    for (const Rational& c : p) {
        coefficients.push_back(c * power);
        power = power / intervals;
    }
    for (const Rational& c : coefficients) out.denominator = cln::lcm(out.denominator, cln::denominator(c));
    for (const Rational& c : coefficients) out.coefficients.push_back(cln::numerator(c * out.denominator));
    return out;
}

Integer value_at(const IndexPolynomial& p, int m) {
    Integer out = 0;
    for (auto c = p.coefficients.rbegin(); c != p.coefficients.rend(); ++c) out = out * m + *c;
    return out;
}

/// Values at m = 0 .. count-1 by forward differences: additions only.
std::vector<Integer> values(const IndexPolynomial& p, int count) {
    const int degree = std::max(static_cast<int>(p.coefficients.size()) - 1, 0);
    std::vector<Integer> differences;
    for (int m = 0; m <= degree; ++m) differences.push_back(value_at(p, m));
    for (int order = 1; order <= degree; ++order) {
        for (int m = degree; m >= order; --m) differences[static_cast<std::size_t>(m)] = differences[static_cast<std::size_t>(m)] - differences[static_cast<std::size_t>(m - 1)];
    }
    std::vector<Integer> out;
    out.reserve(static_cast<std::size_t>(count));
    for (int m = 0; m < count; ++m) {
        out.push_back(differences[0]);
        for (int order = 0; order < degree; ++order) differences[static_cast<std::size_t>(order)] = differences[static_cast<std::size_t>(order)] + differences[static_cast<std::size_t>(order + 1)];
    }
    return out;
}

/// The antiderivative that vanishes at 0.
Coefficients antiderivative(const Coefficients& p) {
    Coefficients out = {0};
    for (std::size_t k = 0; k < p.size(); ++k) out.push_back(p[k] / static_cast<int>(k + 1));
    return out;
}

Rational at_one(const Coefficients& p) {
    Rational out = 0;
    for (const Rational& c : p) out = out + c;
    return out;
}

Fractions held_weights(const Coefficients& kernel, int intervals) {
    const IndexPolynomial area = in_index(antiderivative(kernel), intervals, 1);
    const std::vector<Integer> k1 = values(area, intervals + 1);
    Fractions out;
    out.denominator = area.denominator;
    for (int m = 0; m < intervals; ++m) out.numerators.push_back(k1[static_cast<std::size_t>(m + 1)] - k1[static_cast<std::size_t>(m)]);
    out.numerators.push_back(0);
    return out;
}

/// Sample m multiplies the hat on [(m-1)/M, (m+1)/M]; with K'' = kernel its integral is M (K(m+1) - 2 K(m) + K(m-1)), and
/// at the ends M (K(1) - K(0)) - K'(0) and K'(M) - M (K(M) - K(M-1)).
Fractions interpolated_weights(const Coefficients& kernel, int intervals) {
    const Coefficients first = antiderivative(kernel);
    const IndexPolynomial twice = in_index(antiderivative(first), intervals, intervals);
    const std::vector<Integer> k2 = values(twice, intervals + 1);
    Fractions out;
    const Rational end = at_one(first);
    const Integer common = cln::lcm(twice.denominator, cln::denominator(end));
    const Integer stretch = cln::exquo(common, twice.denominator);
    out.denominator = common;
    const auto k = [&](int m) { return k2[static_cast<std::size_t>(m)]; };
    out.numerators.push_back((k(1) - k(0)) * stretch);
    for (int m = 1; m < intervals; ++m) out.numerators.push_back((k(m + 1) - 2 * k(m) + k(m - 1)) * stretch);
    out.numerators.push_back(cln::numerator(end * common) - (k(intervals) - k(intervals - 1)) * stretch);
    return out;
}

/// Kernel times sample, by the composite rule whose node weights (times M) are given.
template <class NodeWeight>
Fractions rule_weights(const Coefficients& kernel, int intervals, int rule_denominator, NodeWeight node_weight) {
    const IndexPolynomial nodes = in_index(kernel, intervals, Rational(1) / intervals);
    Fractions out;
    out.denominator = nodes.denominator * rule_denominator;
    out.numerators = values(nodes, intervals + 1);
    for (int m = 0; m <= intervals; ++m) {
        Integer& n = out.numerators[static_cast<std::size_t>(m)];
        n = n * node_weight(m);
    }
    return out;
}

Fractions exact_weights(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature) {
    if (hold == plan::Hold::zoh) return held_weights(kernel, intervals);
    if (quadrature == plan::Quadrature::exact) return interpolated_weights(kernel, intervals);
    const auto at_end = [&](int m) { return m == 0 || m == intervals; };
    if (quadrature == plan::Quadrature::trapezoid) return rule_weights(kernel, intervals, 2, [&](int m) { return at_end(m) ? 1 : 2; });
    return rule_weights(kernel, intervals, 3, [&](int m) { return at_end(m) ? 1 : m % 2 == 1 ? 4 : 2; });
}

}  // namespace

std::vector<double> weights(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature, plan::Scalar scalar) {
    const Fractions fractions = exact_weights(kernel, intervals, hold, quadrature);
    std::vector<double> out;
    out.reserve(fractions.numerators.size());
    for (const Integer& n : fractions.numerators) out.push_back(exact::nearest(n, fractions.denominator, scalar));
    return out;
}

exact::Rational integral(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature) {
    if (hold == plan::Hold::zoh || quadrature == plan::Quadrature::exact) return at_one(antiderivative(kernel));
    const Fractions fractions = exact_weights(kernel, intervals, hold, quadrature);
    Integer sum = 0;
    for (const Integer& n : fractions.numerators) sum = sum + n;
    return Rational(sum) / fractions.denominator;
}

exact::Rational square_norm(const Coefficients& kernel) {
    Rational out = 0;
    for (std::size_t i = 0; i < kernel.size(); ++i) {
        for (std::size_t j = 0; j < kernel.size(); ++j) out = out + kernel[i] * kernel[j] / static_cast<int>(i + j + 1);
    }
    return out;
}

}  // namespace algest::kernel
