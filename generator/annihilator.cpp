// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/annihilator.hpp"

#include <ginac/ginac.h>

#include "generator/ginac_exact.hpp"

namespace algest::annihilator {

namespace {

/// d^times/ds^times of  sum_j factor_j(s) Y^(j)(s): the product rule turns (P_j) into (P_j' + P_(j-1)).
std::vector<GiNaC::ex> differentiated(std::vector<GiNaC::ex> factors, const GiNaC::symbol& s, int times) {
    for (int t = 0; t < times; ++t) {
        std::vector<GiNaC::ex> next(factors.size() + 1, 0);
        for (std::size_t j = 0; j < factors.size(); ++j) {
            next[j] += factors[j].diff(s);
            next[j + 1] += factors[j];
        }
        factors = std::move(next);
    }
    return factors;
}

}  // namespace

std::vector<LeibnizTerm> leibniz_expansion(int i, Orders orders, int p) {
    const GiNaC::symbol s("s");
    const std::vector<GiNaC::ex> factors = differentiated({GiNaC::pow(s, orders.kappa + i)}, s, derivatives(p, orders));
    std::vector<LeibnizTerm> out;
    for (std::size_t j = 0; j < factors.size(); ++j) {
        const GiNaC::ex factor = factors[j].expand();
        for (int power = 0; power <= orders.kappa + i; ++power) {
            const GiNaC::ex coefficient = factor.coeff(s, power);
            if (!coefficient.is_zero()) out.push_back({from_ginac(coefficient), power, static_cast<int>(j)});
        }
    }
    return out;
}

bool annihilates(int power, Orders orders) {
    const GiNaC::symbol s("s");
    return GiNaC::ex(GiNaC::pow(s, orders.kappa + power)).diff(s, static_cast<unsigned>(derivatives(1, orders))).expand().is_zero();
}

std::vector<KernelTerm> kernel_terms(int i, int p, Orders orders) {
    std::vector<KernelTerm> out;
    for (const LeibnizTerm& term : leibniz_expansion(i, orders, p)) {
        out.push_back({term.coefficient, time_exponent(term.power, p, orders), term.derivative});
    }
    return out;
}

std::vector<exact::Rational> kernel(int i, int p, Orders orders) {
    std::vector<exact::Rational> out;
    for (const KernelTerm& term : kernel_terms(i, p, orders)) {
        // (1-sigma)^gamma (-sigma)^j = sum_k C(gamma,k) (-1)^(k+j) sigma^(k+j)
        const std::size_t degree = static_cast<std::size_t>(term.gamma + term.j);
        if (out.size() <= degree) out.resize(degree + 1, 0);
        exact::Rational coefficient = term.coefficient / cln::factorial(static_cast<unsigned>(term.gamma));
        if (term.j % 2 != 0) coefficient = -coefficient;
        for (int k = 0; k <= term.gamma; ++k) {
            exact::Rational& c = out[static_cast<std::size_t>(k + term.j)];
            c = c + coefficient;
            coefficient = -coefficient * (term.gamma - k) / (k + 1);
        }
    }
    while (!out.empty() && cln::zerop(out.back())) out.pop_back();
    return out;
}

}  // namespace algest::annihilator
