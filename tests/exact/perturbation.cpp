// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels of a perturbation's coefficients, exact: each sees its own coefficient and no other, and no initial condition.
#include "generator/perturbation.hpp"

#include <catch2/catch.hpp>

#include "tests/exact/closed_form.hpp"

namespace algest {

using exact::Rational;

TEST_CASE("the kernel of c_i sees t^(i-1)/(i-1)! and no other of the kappa terms") {
    for (int n = 0; n <= 4; ++n) {
        for (int kappa = 1; kappa <= 4; ++kappa) {
            for (int i = 1; i <= kappa; ++i) {
                for (int term = 1; term <= kappa; ++term) {
                    INFO("n " << n << ", kappa " << kappa << ", c_" << i << ", term " << term);
                    CHECK(test::moment(perturbation::kernel(i, 0, n, kappa), term - 1) / test::factorial(term - 1) == Rational(term == i ? 1 : 0));
                }
            }
        }
    }
}

TEST_CASE("the kernels of a perturbation's coefficients see no initial condition") {
    // Integrating by parts n times leaves the values of k and its first n-1 derivatives at both ends, which must vanish; then
    // kernel l is (-1)^l times the l-th derivative of kernel 0.
    for (int n = 1; n <= 4; ++n) {
        for (int kappa = 1; kappa <= 3; ++kappa) {
            for (int i = 1; i <= kappa; ++i) {
                INFO("n " << n << ", kappa " << kappa << ", c_" << i);
                std::vector<Rational> wanted = perturbation::kernel(i, 0, n, kappa);
                for (int l = 0; l <= n; ++l) {
                    CHECK(perturbation::kernel(i, l, n, kappa) == wanted);
                    if (l < n) {
                        Rational at_one = 0;
                        for (const Rational& c : wanted) at_one = at_one + c;
                        CHECK(cln::zerop(wanted[0]));
                        CHECK(cln::zerop(at_one));
                    }
                    wanted = test::derivative(wanted);
                    for (Rational& c : wanted) c = -c;
                }
            }
        }
    }
}

}  // namespace algest
