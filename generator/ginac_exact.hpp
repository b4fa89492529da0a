// SPDX-License-Identifier: GPL-3.0-or-later
// Between GiNaC and our exact numbers and polynomials. Coefficients are taken one by one; no GiNaC sum is ever printed.
#pragma once
#include <ginac/ginac.h>

#include <vector>

#include "generator/exact.hpp"
#include "generator/polynomial.hpp"

namespace algest {

inline GiNaC::ex to_ginac(const exact::Rational& value) { return GiNaC::numeric(cln::cl_N(value)); }

/// The expression must be a rational number.
inline exact::Rational from_ginac(const GiNaC::ex& value) {
    return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
}

GiNaC::ex to_ginac(const Polynomial& polynomial, const std::vector<GiNaC::symbol>& variables);

/// The expression must be an expanded polynomial in the variables alone.
Polynomial to_polynomial(const GiNaC::ex& expanded, const std::vector<GiNaC::symbol>& variables);

}  // namespace algest
