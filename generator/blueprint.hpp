// SPDX-License-Identifier: GPL-3.0-or-later
// Plan -> the constant data of a runtime estimator: one construction for the emitter and for replay, so that both run the
// same operations in the same order. No GiNaC.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algest/estimator.hpp"
#include "generator/plan.hpp"

namespace algest::plan {

/// The arrays behind a Blueprint, and its numbers.
template <class S>
struct BlueprintData {
    int samples;   ///< in a window, M + 1
    int signals;   ///< rings
    int rows;      ///< per instant
    int unknowns;  ///< columns without the known side
    algest::Solve solve;
    int solve_instants;
    S keep;
    S condition_limit;
    std::vector<S> tables;  ///< tables x samples, oldest sample first
    std::vector<algest::Functional> functionals;
    std::vector<algest::Term<S>> terms;  ///< grouped by functional, within it in order of rows

    /// The arrays as the runtime reads them: valid until this object changes, moves or ends. Cost: none.
    algest::Blueprint<S> view() const {
        return {{samples,
                 signals,
                 rows,
                 unknowns,
                 {tables.data(), static_cast<int>(tables.size())},
                 {functionals.data(), static_cast<int>(functionals.size())},
                 {terms.data(), static_cast<int>(terms.size())}},
                solve,
                solve_instants,
                keep,
                condition_limit};
    }
};

/// Functionals are the distinct pairs (table, window signal) in the order in which rows and their terms first use them; the
/// terms on the constant 1 share one without a table. The known side goes to column `unknowns`. Numbers of the plan are
/// already rounded to its scalar, so converting them to that scalar changes nothing.
/// Cost: terms x functionals comparisons, once.
template <class S>
BlueprintData<S> make_blueprint(const Plan& plan) {
    BlueprintData<S> data{plan.samples(),
                          static_cast<int>(plan.window_signals.size()),
                          static_cast<int>(plan.rows.size()),
                          static_cast<int>(plan.lumped.size()),
                          plan.solve,
                          plan.solve_instants,
                          static_cast<S>(plan.keep),
                          static_cast<S>(plan.condition_limit),
                          {},
                          {},
                          {}};
    data.tables.reserve(plan.tables.size() * static_cast<std::size_t>(plan.samples()));
    for (const Table& table : plan.tables) {
        for (const double weight : table.weights) data.tables.push_back(static_cast<S>(weight));
    }

    std::vector<std::vector<algest::Term<S>>> terms_of;  // by functional
    for (std::size_t r = 0; r < plan.rows.size(); ++r) {
        for (const RowTerm& term : plan.rows[r].terms) {
            const bool constant = term.signal < 0;
            const std::uint16_t table = constant ? algest::no_table : static_cast<std::uint16_t>(term.table);
            const std::uint16_t signal = constant ? std::uint16_t{0} : static_cast<std::uint16_t>(term.signal);
            std::size_t f = 0;
            while (f < terms_of.size() && (data.functionals[f].table != table || data.functionals[f].signal != signal)) {
                ++f;
            }
            if (f == terms_of.size()) {
                data.functionals.push_back({table, signal, 0, 0});
                terms_of.emplace_back();
            }
            const int column = term.lumped < 0 ? data.unknowns : term.lumped;
            terms_of[f].push_back(
                {static_cast<std::uint16_t>(r), static_cast<std::uint16_t>(column), static_cast<S>(term.factor)});
        }
    }
    for (std::size_t f = 0; f < terms_of.size(); ++f) {
        data.functionals[f].first_term = static_cast<std::uint16_t>(data.terms.size());
        data.functionals[f].terms = static_cast<std::uint16_t>(terms_of[f].size());
        data.terms.insert(data.terms.end(), terms_of[f].begin(), terms_of[f].end());
    }
    return data;
}

}  // namespace algest::plan
