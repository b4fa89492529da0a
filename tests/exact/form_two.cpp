// SPDX-License-Identifier: GPL-3.0-or-later
// Form 2 of the annihilator (003, second theorem): its closed form, and the combination of form 1 that each of its rows is; all exact.
#include "generator/annihilator.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/exact/closed_form.hpp"

namespace algest {

namespace {

using exact::Rational;
using exact::text;
using test::binomial;
using test::factorial;
using test::moment;

/// F~_{i,p}[t^r](1) by 003, equations (12) and (13): sum over j of C(n+p-1, j) i!/(i+j-n-p+1)! (-1)^j (j+r)!/(gamma+j+r+1)!.
Rational closed_moment_of_form_two(int i, int p, int n, int r) {
    Rational out = 0;
    for (int j = n + p - 1 - i; j <= n + p - 1; ++j) {
        const int gamma = 2 * n - i - j + p - 1;
        const Rational c = binomial(n + p - 1, j) * factorial(i) / factorial(i + j - n - p + 1);
        out = out + (j % 2 == 0 ? 1 : -1) * c * factorial(j + r) / factorial(gamma + j + r + 1);
    }
    return out;
}

/// sum of factor * kernel, of form 1, n = 3, derivative i, p = 1, 2, ...
std::vector<Rational> combined(int i, const std::vector<int>& factors) {
    std::vector<Rational> out;
    for (std::size_t p = 0; p < factors.size(); ++p) {
        const auto kernel = annihilator::kernel(i, static_cast<int>(p) + 1, {3, 0});
        out.resize(std::max(out.size(), kernel.size()), 0);
        for (std::size_t k = 0; k < kernel.size(); ++k) out[k] = out[k] + factors[p] * kernel[k];
    }
    while (!out.empty() && cln::zerop(out.back())) out.pop_back();
    return out;
}

}  // namespace

TEST_CASE("form 2: the moments of its kernels are those of 003, equations (12) and (13)") {
    for (int n = 1; n <= 5; ++n) {
        for (int i = 0; i <= n; ++i) {
            for (int p = 1; p <= 5; ++p) {
                const auto kernel = annihilator::kernel(i, p, {n, 0, 2});
                for (int r = 0; r <= 4; ++r) {
                    INFO("n " << n << ", i " << i << ", p " << p << ", r " << r);
                    CHECK(text(moment(kernel, r)) == text(closed_moment_of_form_two(i, p, n, r)));
                }
            }
        }
    }
}

TEST_CASE("form 2: row 1 is that of form 1, and for n = 3 rows 2 and 3 are the combinations of errata.md") {
    for (int n = 1; n <= 5; ++n) {
        for (int kappa = 0; kappa <= 3; ++kappa) {
            for (int i = 0; i <= n; ++i) CHECK(annihilator::kernel(i, 1, {n, kappa, 2}) == annihilator::kernel(i, 1, {n, kappa, 1}));
        }
    }
    for (int i = 0; i <= 3; ++i) {   // at t = 1: row2 = 4 M1_2 - t M1_1, row3 = 20 M1_3 - 8 t M1_2 + t^2 M1_1
        CHECK(annihilator::kernel(i, 2, {3, 0, 2}) == combined(i, {-1, 4}));
        CHECK(annihilator::kernel(i, 3, {3, 0, 2}) == combined(i, {1, -8, 20}));
    }
}

TEST_CASE("form 2: every row is proper, erases initial conditions and kappa perturbation terms") {
    for (int n = 1; n <= 5; ++n) {
        for (int kappa = 0; kappa <= 3; ++kappa) {
            for (int p = 1; p <= 5; ++p) {
                INFO("n " << n << ", kappa " << kappa << ", p " << p);
                for (int i = 0; i <= n; ++i) {
                    for (const auto& term : annihilator::kernel_terms(i, p, {n, kappa, 2})) CHECK(term.gamma >= 0);
                }
                // The initial conditions are what der(f, i) and the i-th derivative of the kernel of order 0 differ by, integrated by
                // parts: none are left if kernel i is that derivative times (-1)^i (errata.md, "Structure").
                std::vector<Rational> wanted = annihilator::kernel(0, p, {n, kappa, 2});
                for (int r = 0; r < kappa; ++r) CHECK(cln::zerop(moment(wanted, r)));
                CHECK_FALSE(cln::zerop(moment(wanted, kappa + p - 1)));   // the first p-1 rows more erase more
                for (int i = 1; i <= n; ++i) {
                    wanted = test::derivative(wanted);
                    for (Rational& c : wanted) c = -c;
                    CHECK(annihilator::kernel(i, p, {n, kappa, 2}) == wanted);
                }
            }
        }
    }
}

}  // namespace algest
