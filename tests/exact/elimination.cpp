// SPDX-License-Identifier: GPL-3.0-or-later
// The resultant against its definition by roots, and how columns are sorted.
#include "generator/elimination.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace algest;
using exact::Rational;

namespace {

std::vector<Rational> with_roots(const std::vector<Rational>& roots, const Rational& leading) {
    std::vector<Rational> c = {leading};
    for (const Rational& r : roots) {
        std::vector<Rational> next(c.size() + 1, 0);
        for (std::size_t k = 0; k < c.size(); ++k) {
            next[k + 1] = next[k + 1] + c[k];
            next[k] = next[k] - r * c[k];
        }
        c = next;
    }
    return c;
}

std::vector<bool> occurring(const std::vector<Rational>& c) {
    std::vector<bool> out;
    for (const Rational& x : c) out.push_back(!cln::zerop(x));
    return out;
}

/// leading_a^deg(b) leading_b^deg(a) product of (root of a - root of b)
Rational by_roots(const std::vector<Rational>& a, const Rational& leading_a, const std::vector<Rational>& b, const Rational& leading_b) {
    Rational out = exact::power(leading_a, static_cast<int>(b.size())) * exact::power(leading_b, static_cast<int>(a.size()));
    for (const Rational& r : a) for (const Rational& s : b) out = out * (r - s);
    return out;
}

void check(const std::vector<Rational>& a, const Rational& leading_a, const std::vector<Rational>& b, const Rational& leading_b) {
    std::vector<Rational> values = with_roots(a, leading_a);
    const std::vector<Rational> second = with_roots(b, leading_b);
    const Polynomial r = elimination::resultant(occurring(values), occurring(second));
    values.insert(values.end(), second.begin(), second.end());
    CHECK(value_at(r, values) == by_roots(a, leading_a, b, leading_b));
}

Polynomial monomial(const Exponents& e) { return {{e, 1}}; }

}  // namespace

TEST_CASE("resultant: products of differences of roots, exactly") {
    const Rational half = Rational(1) / 2;
    check({1, 2, 3}, 5, {-1, half}, 3);
    check({1, -1, 2}, half, {0, 7}, -2);      // coefficients that are zero: x^3 - 2x^2 - x + 2 has all, x^2 - 7x has no constant
    check({2, -2}, 3, {half, 5, -3}, 1);      // 3x^2 - 12
    check({4}, 3, {half, 5, -3, 2}, -7);
    check({1, 2, 3}, 1, {3, 9}, 1);           // a root in common: zero
}

TEST_CASE("columns: what stands alone, squares, order") {
    // R, L, K in this order: R, R^2, L, L^2, K^2, as in equation (35) of Delpoux, Bodson, Floquet.
    const std::vector<Polynomial> columns = {monomial({1, 0, 0}), monomial({2, 0, 0}), monomial({0, 1, 0}), monomial({0, 2, 0}), monomial({0, 0, 2})};
    const std::vector<Rational> sizes = {4, Rational(1) / 64, Rational(1) / 4};

    const elimination::Outcome first = elimination::sort_columns(columns, {true, true, true}, sizes);
    REQUIRE(first.too_many.empty());
    REQUIRE_FALSE(first.too_high);
    const plan::EliminationStage& s = first.sorted.stage;
    REQUIRE(s.alone.size() == 1);
    CHECK(s.alone[0].parameter == 2);
    CHECK(s.alone[0].squared);
    CHECK(s.alone[0].exact == "1/16");
    CHECK(first.sorted.order == std::vector<int>{4, 0, 1, 2, 3});
    CHECK(s.degree_x == 2);
    CHECK(s.degree_y == 2);
    CHECK(s.resultant_degree == 9);   // Bezout: two curves of degree 3
    CHECK(s.degree_of_first + s.degree_of_second == 5);

    const elimination::Outcome second = elimination::sort_columns(columns, {false, true, true}, sizes);
    CHECK(second.sorted.stage.x == -1);
    CHECK(second.sorted.stage.y == 1);
    CHECK(second.sorted.order == std::vector<int>{4, 2, 3, 0, 1});   // R is known: its columns stand last
    CHECK(second.sorted.stage.resultant.empty());

    const std::vector<Polynomial> three = {monomial({1, 1, 0}), monomial({0, 1, 1}), monomial({1, 0, 1}), monomial({1, 0, 0})};
    CHECK(elimination::sort_columns(three, {true, true, true}, sizes).too_many == std::vector<int>{0, 1, 2});
}
