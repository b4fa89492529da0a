// SPDX-License-Identifier: GPL-3.0-or-later
// What properties of rows are stated in: rows of columns, and the sums of magnitudes that their rounding is measured with.
#pragma once
#include <rapidcheck.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lab/plan_rows.hpp"

namespace algest::properties {

/// One a plan's input, all of one length.
using Columns = std::vector<std::vector<double>>;

/// Whole numbers, so that small multiples and sums of them are exact.
inline std::vector<double> whole_numbers(int count, int largest) {
    const auto drawn = *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(count), rc::gen::inRange(-largest, largest + 1));
    return {drawn.begin(), drawn.end()};
}

inline lab::StackedRows rows_of(const plan::Plan& plan, const Columns& columns) {
    std::vector<double> t;
    for (std::size_t k = 0; k < columns[0].size(); ++k) t.push_back(static_cast<double>(k) * plan.period);
    return lab::plan_rows(plan, lab::ring_values(plan, columns, t, {0, t.size()}), 1);
}

/// The rows with every product in them positive.
inline lab::StackedRows magnitudes(plan::Plan plan, Columns columns) {
    for (plan::Table& table : plan.tables) for (double& w : table.weights) w = std::abs(w);
    for (plan::Row& row : plan.rows) for (plan::RowTerm& term : row.terms) term.factor = std::abs(term.factor);
    for (std::vector<double>& column : columns) for (double& x : column) x = std::abs(x);
    return rows_of(plan, columns);
}

/// Of a row's entry, as a part of its magnitude: weights and factors are rounded once, and so are the products and sums of a window.
inline double rounding(const plan::Plan& plan) { return (plan.samples() + 4) * std::numeric_limits<double>::epsilon(); }

}  // namespace algest::properties
