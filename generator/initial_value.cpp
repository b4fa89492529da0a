// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/initial_value.hpp"

namespace algest::model {

using exact::Rational;

std::optional<Rational> at_initial(const Polynomial& p, const Model& model) {
    Rational out = 0;
    for (const auto& [exponents, coefficient] : p) {
        Rational term = coefficient;
        for (std::size_t k = 0; k < exponents.size(); ++k) {
            if (exponents[k] == 0) continue;
            if (!model.parameters[k].initial) return std::nullopt;
            term = term * exact::power(*model.parameters[k].initial, exponents[k]);
        }
        out = out + term;
    }
    return out;
}

std::optional<Rational> at_initial(const Quotient& q, const Model& model) {
    const auto above = at_initial(q.numerator, model);
    const auto below = at_initial(q.denominator, model);
    if (!above || !below || cln::zerop(*below)) return std::nullopt;
    return *above / *below;
}

}  // namespace algest::model
