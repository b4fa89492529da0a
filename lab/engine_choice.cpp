// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/engine_choice.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace algest::lab {

namespace {

constexpr double rebuilt = 4;       // accumulators beside the one that serves
constexpr int highest_degree = 10;  // that moments carry
constexpr double slower = 2.5;      // a multiply-add of moments against one of a dot product, which vectorises: the crossover near 70 samples of design.md, section 5

}  // namespace

EngineChoice cheaper_engine(const plan::Plan& plan) {
    std::set<std::pair<int, int>> products;   // (signal, table): each dot product once
    for (const plan::Row& row : plan.rows) for (const plan::RowTerm& term : row.terms) if (term.table >= 0) products.emplace(term.signal, term.table);
    int degree = 0;
    bool polynomial = plan.quadrature != plan::Quadrature::simpson;
    for (const plan::Table& table : plan.tables) {
        degree = std::max(degree, static_cast<int>(table.kernel.size()) - 1);
        polynomial = polynomial && !table.kernel.empty();
    }
    const double fir = static_cast<double>(products.size()) * plan.samples();
    const double d = degree;
    const double moments = static_cast<double>(plan.window_signals.size()) * ((rebuilt + 2) * (d + 1) + d * (d + 1) / 2) + static_cast<double>(products.size()) * (d + 1);
    return polynomial && degree <= highest_degree && slower * moments < fir ? EngineChoice{"moments", moments} : EngineChoice{"fir", fir};
}

}  // namespace algest::lab
