// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/noise_floor.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "algest/packed.hpp"

namespace algest::generator {

namespace {

/// Of one row: what one standard deviation of `input`'s sample k - before makes of the column of `unknown`, by k.
std::vector<double> influence(const plan::Plan& plan, const plan::Row& row, int input, int unknown, int before) {
    std::vector<double> out(static_cast<std::size_t>(before + plan.samples()), 0.0);
    for (const plan::RowTerm& term : row.terms) {
        if (term.lumped != unknown || term.table < 0) continue;
        const std::vector<double>& weights = plan.tables[static_cast<std::size_t>(term.table)].weights;
        for (const plan::NoiseChannel& channel : plan.noise) {
            if (channel.input != input || channel.signal != term.signal || channel.partial >= 0) continue;
            for (std::size_t k = 0; k < weights.size(); ++k) out[k + static_cast<std::size_t>(before - channel.lag)] += term.factor * channel.factor * weights[k];
        }
    }
    return out;
}

}  // namespace

std::vector<double> noise_floor(const plan::Plan& plan) {
    const bool weighed = std::all_of(plan.tables.begin(), plan.tables.end(), [](const plan::Table& t) { return !t.weights.empty(); });
    if (plan.solve != algest::Solve::robust || !plan.uncertain() || !weighed) return {};
    const int n = static_cast<int>(plan.lumped.size());
    int before = 0;
    for (const plan::NoiseChannel& channel : plan.noise) before = std::max(before, channel.lag);
    std::vector<double> out(static_cast<std::size_t>(packed_size(n)), 0.0);
    for (const plan::Row& row : plan.rows) {
        for (int input = 0; input < static_cast<int>(plan.inputs.size()); ++input) {
            std::vector<std::vector<double>> columns;
            for (int u = 0; u < n; ++u) columns.push_back(influence(plan, row, input, u, before));
            std::size_t entry = 0;
            for (std::size_t u = 0; u < columns.size(); ++u) {
                for (std::size_t v = u; v < columns.size(); ++v, ++entry) {
                    double sum = 0.0;
                    for (std::size_t k = 0; k < columns[u].size(); ++k) sum += columns[u][k] * columns[v][k];
                    out[entry] += floor_over_noise * plan.solve_instants * sum;
                }
            }
        }
    }
    if (std::all_of(out.begin(), out.end(), [](double x) { return x == 0.0; })) return {};
    return out;
}

std::vector<double> noise_of_rows(const plan::Plan& plan) {
    std::vector<double> out;
    for (const plan::Row& row : plan.rows) {
        std::vector<std::vector<double>> columns(plan.lumped.size());
        for (const plan::RowTerm& term : row.terms) {
            const std::vector<double>& weights = plan.tables[static_cast<std::size_t>(term.table)].weights;
            if (weights.empty()) return {};
            if (term.lumped < 0 || term.signal != plan.output) continue;
            for (const double w : weights) columns[static_cast<std::size_t>(term.lumped)].push_back(term.factor * w);
        }
        for (std::size_t u = 0; u < columns.size(); ++u) {
            for (std::size_t v = u; v < columns.size(); ++v) {
                const bool both = !columns[u].empty() && !columns[v].empty();   // else one is of the input
                out.push_back(both ? std::inner_product(columns[u].begin(), columns[u].end(), columns[v].begin(), 0.0) : 0.0);
            }
        }
    }
    return out;
}

}  // namespace algest::generator
