// SPDX-License-Identifier: GPL-3.0-or-later
// Weights as one polynomial and two ends: summed up exactly they are the tables' weights, bit for bit, for every hold and window.
#include <catch2/catch.hpp>

#include <vector>

#include "generator/annihilator.hpp"
#include "generator/window_polynomial.hpp"

using namespace algest;
using exact::Rational;

namespace {

/// Every weight, exactly, from the polynomial.
std::vector<Rational> summed(const kernel::WindowPolynomial& p, int intervals, const Rational& step) {
    std::vector<Rational> out;
    for (int m = 0; m <= intervals; ++m) {
        const Rational v = (2 * m - intervals) * step;
        Rational weight = 0;
        Rational power = 1;
        for (const Rational& c : p.coefficients) {
            weight = weight + c * power;
            power = power * v;
        }
        out.push_back(weight + (m == 0 ? p.oldest : Rational(0)) + (m == intervals ? p.newest : Rational(0)));
    }
    return out;
}

}  // namespace

TEST_CASE("a window polynomial is the table of weights") {
    for (const int n : {1, 2, 4}) {
        for (const int intervals : {2, 3, 7, 40}) {
            const Rational step = kernel::coordinate_step(intervals);
            CHECK(step * 2 * intervals <= 1);
            CHECK(step * 4 * intervals > 1);
            for (int i = 0; i <= n; ++i) {
                const auto k = annihilator::kernel(i, 2, {n, 1, 1});
                for (const auto& [hold, quadrature] : {std::pair(plan::Hold::zoh, plan::Quadrature::exact), std::pair(plan::Hold::linear, plan::Quadrature::exact),
                                                       std::pair(plan::Hold::linear, plan::Quadrature::trapezoid)}) {
                    const auto p = kernel::window_polynomial(k, intervals, hold, quadrature, step);
                    CHECK(p.coefficients.size() == k.size());
                    const auto weights = summed(p, intervals, step);
                    const auto table = kernel::weights(k, intervals, hold, quadrature, plan::Scalar::float64);
                    Rational sum = 0;
                    for (std::size_t m = 0; m < table.size(); ++m) {
                        CHECK(exact::nearest(weights[m], plan::Scalar::float64) == table[m]);
                        sum = sum + weights[m];
                    }
                    CHECK(sum == kernel::integral(k, intervals, hold, quadrature));   // the functional of the constant 1
                }
            }
        }
    }
}

TEST_CASE("a growing polynomial is the table of weights of every window, but for the oldest sample") {
    for (const int n : {1, 3}) {
        for (int i = 0; i <= n; ++i) {
            const auto k = annihilator::kernel(i, 2, {n, 0, 1});
            for (const plan::Hold hold : {plan::Hold::zoh, plan::Hold::linear}) {
                const kernel::GrowingPolynomial p = kernel::growing_polynomial(k, hold);
                for (const int intervals : {2, 3, 7, 40}) {
                    const Rational h = Rational(1) / intervals;
                    const auto table = kernel::weights(k, intervals, hold, plan::Quadrature::exact, plan::Scalar::float64);
                    kernel::WindowPolynomial there{kernel::Coefficients(k.size(), 0), 0, 0};
                    Rational power = h;
                    for (std::size_t order = 0; order < p.by_power.size(); ++order) {
                        for (std::size_t j = 0; j < k.size(); ++j) there.coefficients[j] = there.coefficients[j] + p.by_power[order][j] * power;
                        there.newest = there.newest + p.newest[order] * power;
                        power = power * h;
                    }
                    const auto weights = summed(there, intervals, h);
                    for (std::size_t m = 1; m < table.size(); ++m) CHECK(exact::nearest(weights[m], plan::Scalar::float64) == table[m]);
                }
            }
        }
    }
}

TEST_CASE("two parts of a number are nearest, and nearest to what is left") {
    const Rational third = Rational(1) / 3;
    const exact::TwoParts parts = exact::nearest_two(third, plan::Scalar::float32);
    CHECK(parts.high == static_cast<double>(1.0F / 3.0F));
    CHECK(parts.low == static_cast<double>(static_cast<float>(-1.0 / 3.0 / 33554432.0)));   // 1/3 in 24 bits is (2^25 + 1) / (3 2^25)
    CHECK(exact::nearest_two(Rational(5) / 8, plan::Scalar::float32).low == 0.0);
    CHECK(exact::nearest_two(Rational(-7), plan::Scalar::float64).high == -7.0);
}
