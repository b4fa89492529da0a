// SPDX-License-Identifier: GPL-3.0-or-later
// Roots that are known beforehand: products of linear factors multiplied out in the test.
#include "algest/polynomial_roots.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace algest;

namespace {

/// (x - r1)(x - r2)...; exact while the roots are small integers or powers of two.
std::vector<double> with_roots(const std::vector<double>& roots, double leading = 1) {
    std::vector<double> c = {leading};
    for (const double r : roots) {
        std::vector<double> next(c.size() + 1, 0.0);
        for (std::size_t k = 0; k < c.size(); ++k) {
            next[k + 1] += c[k];
            next[k] -= r * c[k];
        }
        c = next;
    }
    return c;
}

std::vector<double> found(const std::vector<double>& c) {
    const int degree = static_cast<int>(c.size()) - 1;
    std::vector<double> scratch(static_cast<std::size_t>(real_roots_scratch(degree)));
    std::vector<double> roots(static_cast<std::size_t>(root_places(degree)));
    std::vector<double> real(roots.size());
    real_roots(c.data(), degree, scratch.data(), roots.data(), real.data());
    std::vector<double> out;
    for (std::size_t k = 0; k < roots.size(); ++k) if (real[k] > 0) out.push_back(roots[k]);
    std::sort(out.begin(), out.end());
    return out;
}

/// Every expected root is among them, and nothing else is, to `within`.
void expect(const std::vector<double>& c, const std::vector<double>& roots, double within) {
    const std::vector<double> all = found(c);
    const auto near = [&](double a, double b) { return std::abs(a - b) <= within * std::max(1.0, std::abs(b)); };
    for (const double r : roots) CHECK(std::any_of(all.begin(), all.end(), [&](double f) { return near(f, r); }));
    for (const double f : all) {
        INFO(f);
        CHECK(std::any_of(roots.begin(), roots.end(), [&](double r) { return near(f, r); }));
    }
}

}  // namespace

TEST_CASE("simple real roots, inside and outside of [-1, 1]") {
    // Conditions of these roots are below 1e6, and rounding is 1e-16.
    expect(with_roots({0.5}), {0.5}, 1e-15);
    expect(with_roots({-2, 0.25, 3}), {-2, 0.25, 3}, 1e-13);
    expect(with_roots({-1, 1}), {-1, 1}, 1e-13);
    expect(with_roots({1, 2, 3, 4, 5, 6, 7}), {1, 2, 3, 4, 5, 6, 7}, 1e-9);
    expect(with_roots({-64, -1, 0.0078125, 0.5, 1024}, -3), {-64, -1, 0.0078125, 0.5, 1024}, 1e-12);
    expect(with_roots({0, 0.5, 8}), {0, 0.5, 8}, 1e-13);
}

TEST_CASE("no real roots, and some") {
    CHECK(found({1, 0, 1}).empty());
    CHECK(found({5, 2, 3, 0, 1}).empty());   // x^4 + 3 x^2 + 2 x + 5 > (x + 1)^2
    expect({-6, 11, -6, 1, 0, 0}, {1, 2, 3}, 1e-12);   // the leading coefficients are zero
    std::vector<double> c(6, 0.0);   // (x^2 + 1) (x - 2) (x + 1/2)(x + 3)
    const std::vector<double> real = with_roots({2, -0.5, -3});
    for (std::size_t k = 0; k < real.size(); ++k) {
        c[k] += real[k];
        c[k + 2] += real[k];
    }
    expect(c, {2, -0.5, -3}, 1e-13);
}

TEST_CASE("a root that the polynomial only touches is found as far as rounding lets it be") {
    expect(with_roots({0.5, 0.5}), {0.5}, 1e-7);
    expect(with_roots({3, 3, -1}), {3, -1}, 1e-6);
}

TEST_CASE("what is no polynomial has no roots") {
    CHECK(found({0, 0, 0}).empty());
    CHECK(found({1, std::numeric_limits<double>::quiet_NaN(), 1}).empty());
    CHECK(found({std::numeric_limits<double>::infinity(), 1, 1}).empty());
    CHECK(found({7, 0, 0}).empty());
}

TEST_CASE("coefficients of any size: the roots are those of the polynomial, not of its scale") {
    for (const double scale : {1e-300, 1e-9, 1e200}) {
        std::vector<double> c = with_roots({-2, 0.25, 3});
        for (double& x : c) x *= scale;
        expect(c, {-2, 0.25, 3}, 1e-13);
    }
}
