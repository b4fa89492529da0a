// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/kernel.hpp"

#include <algorithm>

#include "generator/wide_integer.hpp"

namespace algest::kernel {

namespace {

using exact::Integer;
using exact::Rational;

/// Weights over one common denominator: weight m is numerators.at(m) / denominator.
struct Fractions {
    exact::WideIntegers numerators;
    Integer denominator = 1;
};

/// A polynomial of the sample index with integer coefficients over a common denominator.
struct IndexPolynomial {
    std::vector<Integer> coefficients;   ///< lowest power first
    Integer denominator = 1;
};

/// p(m/M) * scale as a polynomial in the index m; its denominator is a multiple of `divides`.
IndexPolynomial in_index(const Coefficients& p, int intervals, const Rational& scale, const Integer& divides) {
    IndexPolynomial out;
    out.denominator = divides;
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

/// Forward differences at m = 0: the value, the first difference, ..., the one that is constant.
std::vector<Integer> differences(const IndexPolynomial& p) {
    const std::size_t degree = p.coefficients.empty() ? 0 : p.coefficients.size() - 1;
    std::vector<Integer> out;
    for (std::size_t m = 0; m <= degree; ++m) out.push_back(value_at(p, static_cast<int>(m)));
    for (std::size_t order = 1; order <= degree; ++order) {
        for (std::size_t m = degree; m >= order; --m) out[m] = out[m] - out[m - 1];
    }
    return out;
}

/// Bits of the largest value on 0 .. intervals, with room for the factor of a rule and for differences.
std::size_t bits_of_values(const IndexPolynomial& p, int intervals) {
    Integer bound = 0;
    Integer power = 1;
    for (const Integer& c : p.coefficients) {
        bound = bound + cln::abs(c) * power;
        power = power * intervals;
    }
    return static_cast<std::size_t>(cln::integer_length(bound)) + 8;
}

/// The order-th forward difference of p at m = 0 .. count-1.
exact::WideIntegers difference_values(const IndexPolynomial& p, std::size_t order, std::size_t count, int intervals) {
    std::vector<Integer> all = differences(p);
    if (order >= all.size()) all.resize(order + 1, 0);
    return exact::sequence({all.begin() + static_cast<std::ptrdiff_t>(order), all.end()}, count, bits_of_values(p, intervals));
}

Rational at_one(const Coefficients& p) {
    Rational out = 0;
    for (const Rational& c : p) out = out + c;
    return out;
}

/// Sample m is multiplied by K(m+1) - K(m), with K' = kernel; the newest by nothing.
Fractions held_weights(const Coefficients& kernel, int intervals) {
    const IndexPolynomial area = in_index(antiderivative(kernel), intervals, 1, 1);
    const std::size_t count = static_cast<std::size_t>(intervals) + 1;
    Fractions out{difference_values(area, 1, count, intervals + 1), area.denominator};
    for (std::size_t w = 0; w < out.numerators.words; ++w) out.numerators.at(count - 1)[w] = 0;
    return out;
}

/// Sample m multiplies the hat on [(m-1)/M, (m+1)/M]; with K'' = kernel its integral is M (K(m+1) - 2 K(m) + K(m-1)), and
/// at the ends M (K(1) - K(0)) - K'(0) and K'(M) - M (K(M) - K(M-1)), where K(0) = K'(0) = 0.
Fractions interpolated_weights(const Coefficients& kernel, int intervals) {
    const Coefficients first = antiderivative(kernel);
    const Rational end = at_one(first);
    const IndexPolynomial twice = in_index(antiderivative(first), intervals, intervals, cln::denominator(end));
    const std::size_t count = static_cast<std::size_t>(intervals) + 1;
    // Entry m of the second differences belongs to sample m+1: one place is left in front, and the last is replaced.
    std::vector<Integer> shifted = differences(twice);
    shifted.resize(std::max<std::size_t>(shifted.size(), 3), 0);
    shifted.erase(shifted.begin(), shifted.begin() + 2);
    Fractions out{{}, twice.denominator};
    const exact::WideIntegers inner = exact::sequence(shifted, count, bits_of_values(twice, intervals + 1));
    out.numerators.words = inner.words;
    out.numerators.data.assign(inner.words, 0);
    out.numerators.data.insert(out.numerators.data.end(), inner.data.begin(), inner.data.end() - static_cast<std::ptrdiff_t>(inner.words));
    exact::assign(out.numerators, 0, value_at(twice, 1));
    exact::assign(out.numerators, count - 1, cln::numerator(end * twice.denominator) - value_at(twice, intervals) + value_at(twice, intervals - 1));
    return out;
}

/// Kernel times sample, by the composite rule whose node weights (times M and rule_denominator) are given.
template <class NodeWeight>
Fractions rule_weights(const Coefficients& kernel, int intervals, int rule_denominator, NodeWeight node_weight) {
    const IndexPolynomial nodes = in_index(kernel, intervals, Rational(1) / intervals, 1);
    const std::size_t count = static_cast<std::size_t>(intervals) + 1;
    Fractions out{difference_values(nodes, 0, count, intervals), nodes.denominator * rule_denominator};
    for (std::size_t m = 0; m < count; ++m) exact::multiply(out.numerators, m, node_weight(static_cast<int>(m)));
    return out;
}

Fractions exact_weights(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature) {
    if (hold == plan::Hold::zoh) return held_weights(kernel, intervals);
    if (quadrature == plan::Quadrature::exact) return interpolated_weights(kernel, intervals);
    const auto at_end = [&](int m) { return m == 0 || m == intervals; };
    if (quadrature == plan::Quadrature::trapezoid) return rule_weights(kernel, intervals, 2, [&](int m) { return at_end(m) ? 1U : 2U; });
    return rule_weights(kernel, intervals, 3, [&](int m) { return at_end(m) ? 1U : m % 2 == 1 ? 4U : 2U; });
}

}  // namespace

Coefficients coefficients(const std::vector<std::string>& texts) {
    Coefficients out;
    for (const std::string& c : texts) out.push_back(exact::from_text(c));
    return out;
}

Rational value_at(const Coefficients& p, const Rational& x) {
    Rational out = 0;
    for (auto c = p.rbegin(); c != p.rend(); ++c) out = out * x + *c;
    return out;
}

Rational moment(const Coefficients& kernel, int power) {
    Rational out = 0;
    for (std::size_t k = 0; k < kernel.size(); ++k) out = out + kernel[k] / (static_cast<int>(k) + power + 1);
    return out;
}

Coefficients antiderivative(const Coefficients& p) {
    Coefficients out = {0};
    for (std::size_t k = 0; k < p.size(); ++k) out.push_back(p[k] / static_cast<int>(k + 1));
    return out;
}

std::vector<double> weights(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature, plan::Scalar scalar) {
    const Fractions fractions = exact_weights(kernel, intervals, hold, quadrature);
    const exact::QuotientRounder nearest(fractions.denominator, scalar);
    std::vector<double> out;
    out.reserve(static_cast<std::size_t>(intervals) + 1);
    for (std::size_t m = 0; m <= static_cast<std::size_t>(intervals); ++m) out.push_back(nearest(fractions.numerators.at(m), fractions.numerators.words));
    return out;
}

exact::Rational integral(const Coefficients& kernel, int intervals, plan::Hold hold, plan::Quadrature quadrature) {
    if (hold == plan::Hold::zoh || quadrature == plan::Quadrature::exact) return at_one(antiderivative(kernel));
    const Fractions fractions = exact_weights(kernel, intervals, hold, quadrature);
    Integer sum = 0;
    for (std::size_t m = 0; m <= static_cast<std::size_t>(intervals); ++m) sum = sum + exact::to_integer(fractions.numerators.at(m), fractions.numerators.words);
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
