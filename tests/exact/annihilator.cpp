// SPDX-License-Identifier: GPL-3.0-or-later
// The derived annihilator against its closed form and against what it is for, for n <= 5 and kappa <= 3, all exact.
#include "generator/annihilator.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/exact/closed_form.hpp"

namespace algest {

namespace {

using annihilator::Orders;
using exact::Rational;
using exact::text;
using test::closed_moment;
using test::factorial;
using test::falling;
using test::moment;

constexpr int largest_n = 5;
constexpr int largest_kappa = 3;
constexpr int largest_p = 6;

template <class Use>
void for_all_orders(Use use) {
    for (int n = 1; n <= largest_n; ++n) {
        for (int kappa = 0; kappa <= largest_kappa; ++kappa) {
            INFO("n = " << n << ", kappa = " << kappa);
            use(n, kappa);
        }
    }
}

/// d^times/ds^times of s^kappa s^i s^power, by the terms of the Leibniz expansion: its factor, if all of them give one and the
/// same power of s.
Rational expanded(const std::vector<annihilator::LeibnizTerm>& terms, int power, int left_power) {
    Rational out = 0;
    for (const annihilator::LeibnizTerm& t : terms) {
        CHECK(t.power + power - t.derivative == left_power);
        out = out + t.coefficient * falling(power, t.derivative);
    }
    return out;
}

}  // namespace

TEST_CASE("the moments of the derived kernels are those of the oracle") {
    const std::string path = std::string(ALGEST_SHARED) + "/oracle/kernel_moments.csv";
    std::ifstream file(path);
    if (!file) {
        WARN("skipped: there is no " << path);
        return;
    }
    std::string line;
    std::getline(file, line);
    REQUIRE(line.substr(0, line.find('\r')) == "n,kappa,i,p,r,F_ip[t^r](1) exact,float");
    int rows = 0;
    while (std::getline(file, line)) {
        INFO(line);
        std::istringstream cells(line);
        int n = 0, kappa = 0, i = 0, p = 0, r = 0;
        char comma = 0;
        std::string fraction;
        REQUIRE(cells >> n >> comma >> kappa >> comma >> i >> comma >> p >> comma >> r >> comma);
        REQUIRE(std::getline(cells, fraction, ','));
        // The text of an exact number is canonical: equal texts are equal rationals.
        CHECK(text(moment(annihilator::kernel(i, p, {n, kappa}), r)) == fraction);
        CHECK(text(closed_moment(i, p, n, kappa, r)) == fraction);
        ++rows;
    }
    CHECK(rows == 1440);
}

TEST_CASE("the moments of the derived kernels are those of the closed form") {
    for_all_orders([](int n, int kappa) {
        for (int i = 0; i <= n; ++i) {
            for (int p = 1; p <= largest_p; ++p) {
                const std::vector<Rational> kernel = annihilator::kernel(i, p, {n, kappa});
                // As many moments as the polynomial has coefficients determine it.
                for (int r = 0; r < static_cast<int>(kernel.size()); ++r) {
                    INFO("i = " << i << ", p = " << p << ", r = " << r);
                    CHECK(text(moment(kernel, r)) == text(closed_moment(i, p, n, kappa, r)));
                }
                // Degree gamma + j, as every term has it; the highest coefficient may cancel.
                CHECK(static_cast<int>(kernel.size()) <= kappa + 2 * n + p - i);
            }
        }
    });
}

TEST_CASE("the Leibniz coefficients are c_ij") {
    for_all_orders([](int n, int kappa) {
        for (int i = 0; i <= n; ++i) {
            const auto terms = annihilator::leibniz_expansion(i, {n, kappa});
            std::size_t at = 0;
            for (int j = 0; j <= kappa + n; ++j) {
                const Rational wanted = test::c(i, j, n, kappa);
                if (cln::zerop(wanted)) continue;
                INFO("i = " << i << ", j = " << j);
                REQUIRE(at < terms.size());
                CHECK(terms[at].derivative == j);
                CHECK(terms[at].power == i + j - n);
                CHECK(text(terms[at].coefficient) == text(wanted));
                ++at;
            }
            CHECK(at == terms.size());
            for (int p = 1; p <= largest_p; ++p) {
                for (const annihilator::KernelTerm& t : annihilator::kernel_terms(i, p, {n, kappa})) {
                    CHECK(t.gamma == kappa + 2 * n + p - i - t.j - 1);
                    CHECK(text(t.coefficient) == text(test::c(i, t.j, n, kappa)));
                }
            }
        }
    });
}

TEST_CASE("the Leibniz expansion acts on powers of s as the annihilator does") {
    for_all_orders([](int n, int kappa) {
        for (int i = 0; i <= n; ++i) {
            const auto terms = annihilator::leibniz_expansion(i, {n, kappa});
            for (int power = -8; power <= 8; ++power) {
                INFO("i = " << i << ", on s^" << power);
                CHECK(text(expanded(terms, power, i + power - n)) == text(Rational(falling(kappa + i + power, kappa + n))));
            }
        }
    });
}

TEST_CASE("the annihilator erases initial conditions and kappa perturbation terms, and nothing else") {
    for_all_orders([](int n, int kappa) {
        const auto expansion = annihilator::leibniz_expansion(0, {n, kappa});
        for (int power = -(kappa + 4); power <= n + 4; ++power) {
            // The initial conditions of outputs and of inputs (m <= n) are s^0 .. s^(n-1); c_l t^(l-1)/(l-1)! is c_l s^-l.
            const bool erased = power >= -kappa && power <= n - 1;
            INFO("s^" << power);
            CHECK(annihilator::annihilates(power, {n, kappa}) == erased);
            CHECK(cln::zerop(expanded(expansion, power, power - n)) == erased);
        }
    });
}

TEST_CASE("a functional of a derivative needs no initial condition") {
    // F_{i,p}[f] = F_{0,p}[f^(i)] for every polynomial f: by parts, and every boundary term at both ends is gone.
    for_all_orders([](int n, int kappa) {
        for (int p = 1; p <= largest_p; ++p) {
            const std::vector<Rational> undifferentiated = annihilator::kernel(0, p, {n, kappa});
            for (int i = 0; i <= n; ++i) {
                const std::vector<Rational> kernel = annihilator::kernel(i, p, {n, kappa});
                for (int r = 0; r <= 2 * n + kappa; ++r) {
                    INFO("i = " << i << ", p = " << p << ", f = t^" << r);
                    const Rational of_derivative = r < i ? Rational(0) : falling(r, i) * moment(undifferentiated, r - i);
                    CHECK(text(moment(kernel, r)) == text(of_derivative));
                }
            }
        }
    });
}

TEST_CASE("the kernel of F_i is (-1)^i times the i-th derivative of that of F_0") {
    for_all_orders([](int n, int kappa) {
        for (int p = 1; p <= largest_p; ++p) {
            std::vector<Rational> wanted = annihilator::kernel(0, p, {n, kappa});
            for (int i = 0; i <= n; ++i) {
                const std::vector<Rational> kernel = annihilator::kernel(i, p, {n, kappa});
                INFO("i = " << i << ", p = " << p);
                REQUIRE(kernel.size() == wanted.size());
                for (std::size_t k = 0; k < kernel.size(); ++k)
                    CHECK(text(kernel[k]) == text((i % 2 == 0 ? 1 : -1) * wanted[k]));
                wanted = test::derivative(wanted);
            }
        }
    });
}

TEST_CASE("the kernel of F_0 has the factor s^n (1-s)^n and is orthogonal to t^m, m < kappa") {
    for_all_orders([](int n, int kappa) {
        for (int p = 1; p <= largest_p; ++p) {
            INFO("p = " << p);
            const std::vector<Rational> kernel = annihilator::kernel(0, p, {n, kappa});
            // A zero of order n at an end: the derivatives 0 .. n-1 vanish there. At the older end the n-th does not.
            std::vector<Rational> derivative = kernel;
            for (int order = 0; order < n; ++order) {
                Rational at_one = 0;
                for (const Rational& coefficient : derivative) at_one = at_one + coefficient;
                CHECK(text(at_one) == "0");
                CHECK(text(derivative.at(0)) == "0");
                derivative = test::derivative(derivative);
            }
            CHECK(text(derivative.at(0)) != "0");
            for (int m = 0; m < kappa; ++m) CHECK(text(moment(kernel, m)) == "0");
            // One more is not erased: Pi s^-(kappa+1) = (-1)^(kappa+n) (kappa+n)! s^-(kappa+n+1), by s^-(kappa+n+p) a power of t.
            const Rational next = (n + kappa) % 2 == 0 ? factorial(kappa + n) : -factorial(kappa + n);
            CHECK(text(moment(kernel, kappa)) == text(next * factorial(kappa) / factorial(2 * kappa + 2 * n + p)));
        }
    });
}

}  // namespace algest
