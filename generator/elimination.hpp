// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares under polynomial constraints as data: which parameters stand alone in a column, and the resultant of the extremum equations of the
// other two (Delpoux, Bodson, Floquet 2014, appendix A).
#pragma once
#include <string>
#include <vector>

#include "generator/plan.hpp"
#include "generator/polynomial.hpp"

namespace algest::elimination {

/// The resultant in x of two polynomials a_0 + a_1 x + ... and b_0 + b_1 x + ... with coefficients of their own: exponents of a_0, a_1, ...,
/// b_0, b_1, .... Some of them may be known to be zero. degrees: at most `largest_degrees` together.
Polynomial resultant(const std::vector<bool>& a, const std::vector<bool>& b);

/// Two polynomials of degree 3 have a resultant of 34 terms, of degree 4 one of 219, of eight factors each: 3.5 kB of tables and 10^5 multiply-adds
/// a solve. Beyond that the terms grow sevenfold with each degree, too many for a controller.
constexpr int largest_degrees = 8;

/// What a stage makes of its columns.
struct Sorted {
    plan::EliminationStage stage;      ///< without names, first_column and equations
    std::vector<int> order;            ///< of the columns: alone, of the unknown parameters, of known ones
};

/// Columns, polynomials in all parameters, sorted for elimination. unknown: the parameters that this stage is to give. sizes: of all parameters.
/// The parameters that do not stand alone must be two at most, or `too_many` holds them and the rest is of no use; too_high: their degrees are beyond
/// largest_degrees. Exact: coefficients are texts, not yet rounded. Cost: the determinant of the resultant.
struct Outcome {
    Sorted sorted;
    std::vector<int> too_many;
    bool too_high;
};
Outcome sort_columns(const std::vector<Polynomial>& columns, const std::vector<bool>& unknown, const std::vector<exact::Rational>& sizes);

}  // namespace algest::elimination
