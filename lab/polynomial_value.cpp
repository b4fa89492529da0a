// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/polynomial_value.hpp"

namespace algest::lab {

double value_of(const Polynomial& p, const std::vector<double>& parameters) {
    double out = 0;
    for (const auto& [exponents, coefficient] : p) {
        double term = exact::nearest(coefficient, plan::Scalar::float64);
        for (std::size_t k = 0; k < exponents.size(); ++k) for (int e = 0; e < exponents[k]; ++e) term *= parameters[k];
        out += term;
    }
    return out;
}

double slope_of(const Polynomial& p, const std::vector<double>& parameters, std::size_t k) {
    double out = 0;
    for (const auto& [exponents, coefficient] : p) {
        if (exponents[k] == 0) continue;
        double term = exact::nearest(coefficient, plan::Scalar::float64) * exponents[k];
        for (std::size_t q = 0; q < exponents.size(); ++q) {
            const int times = exponents[q] - (q == k ? 1 : 0);
            for (int e = 0; e < times; ++e) term *= parameters[q];
        }
        out += term;
    }
    return out;
}

}  // namespace algest::lab
