// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/ginac_exact.hpp"

namespace algest {

GiNaC::ex to_ginac(const Polynomial& polynomial, const std::vector<GiNaC::symbol>& variables) {
    GiNaC::ex out = 0;
    for (const auto& [exponents, coefficient] : polynomial) {
        GiNaC::ex term = to_ginac(coefficient);
        for (std::size_t k = 0; k < variables.size(); ++k) {
            if (exponents[k] != 0) term *= GiNaC::pow(variables[k], exponents[k]);
        }
        out += term;
    }
    return out;
}

Polynomial to_polynomial(const GiNaC::ex& expanded, const std::vector<GiNaC::symbol>& variables) {
    Polynomial out;
    const auto add_term = [&](const GiNaC::ex& term) {
        exact::Rational coefficient = 1;
        Exponents exponents(variables.size(), 0);
        const auto take = [&](const GiNaC::ex& factor) {
            if (GiNaC::is_a<GiNaC::numeric>(factor)) {
                coefficient = coefficient * from_ginac(factor);
                return;
            }
            const bool is_power = GiNaC::is_a<GiNaC::power>(factor);
            const GiNaC::ex base = is_power ? factor.op(0) : factor;
            const int e = is_power ? GiNaC::ex_to<GiNaC::numeric>(factor.op(1)).to_int() : 1;
            for (std::size_t k = 0; k < variables.size(); ++k) if (base.is_equal(variables[k])) exponents[k] += e;
        };
        if (GiNaC::is_a<GiNaC::mul>(term)) for (const GiNaC::ex& factor : term) take(factor);
        else take(term);
        out = sum(out, Polynomial{{exponents, coefficient}});
    };
    if (GiNaC::is_a<GiNaC::add>(expanded)) for (const GiNaC::ex& term : expanded) add_term(term);
    else if (!expanded.is_zero()) add_term(expanded);
    return out;
}

}  // namespace algest
