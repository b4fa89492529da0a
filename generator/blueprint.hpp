// SPDX-License-Identifier: GPL-3.0-or-later
// Plan -> the constant data of a runtime estimator: one construction for the emitter and for replay, so that both run the
// same operations in the same order. No GiNaC.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "algest/estimator.hpp"
#include "algest/growing_moments.hpp"
#include "generator/elimination_data.hpp"
#include "generator/plan.hpp"

namespace algest::plan {

/// The arrays behind a RowSet.
template <class S>
struct RowData {
    int rows;
    std::vector<algest::Functional> functionals;
    std::vector<algest::Term<S>> terms;  ///< grouped by functional, within it in order of rows
};

/// Functionals are the distinct pairs (table, window signal) in the order in which rows and their terms first use them; the
/// terms on the constant 1 share one without a table. The known side goes to column `unknowns`.
/// Cost: terms x functionals comparisons, once.
template <class S>
RowData<S> make_rows(const std::vector<Row>& rows, int unknowns) {
    RowData<S> data{static_cast<int>(rows.size()), {}, {}};
    std::vector<std::vector<algest::Term<S>>> terms_of;  // by functional
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (const RowTerm& term : rows[r].terms) {
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
            const int column = term.lumped < 0 ? unknowns : term.lumped;
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

/// The arrays behind a PointRows.
struct PointRowData {
    std::vector<std::uint16_t> first = {};
    std::vector<std::uint16_t> columns = {};
    std::vector<std::uint16_t> group = {};
    int groups = 0;

    /// Valid until this object changes, moves or ends. Cost: none.
    algest::PointRows view() const {
        return {{first.data(), static_cast<int>(first.size())}, {columns.data(), static_cast<int>(columns.size())}, {group.data(), static_cast<int>(group.size())}, groups};
    }
};

/// Groups: the stages of an elimination, by the columns of the rows; else one. Empty where a plan keeps nothing of the points' noise.
inline PointRowData make_point_rows(const Plan& plan) {
    PointRowData out;
    if (!plan.points_above_noise()) return out;
    out.groups = plan.elimination ? static_cast<int>(plan.elimination->stages.size()) : 1;
    for (const Row& row : plan.rows) {
        std::vector<std::uint16_t> columns = {static_cast<std::uint16_t>(plan.lumped.size())};
        for (const RowTerm& term : row.terms) if (term.lumped >= 0) columns.push_back(static_cast<std::uint16_t>(term.lumped));
        std::sort(columns.begin(), columns.end());
        columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
        int group = 0;
        for (int s = 0; plan.elimination && s < out.groups; ++s) if (plan.elimination->stages[static_cast<std::size_t>(s)].first_column <= columns[0]) group = s;
        out.first.push_back(static_cast<std::uint16_t>(out.columns.size()));
        out.columns.insert(out.columns.end(), columns.begin(), columns.end());
        out.group.push_back(static_cast<std::uint16_t>(group));
    }
    out.first.push_back(static_cast<std::uint16_t>(out.columns.size()));
    return out;
}

/// The arrays behind a Blueprint, and its numbers.
template <class S>
struct BlueprintData {
    int samples;   ///< in a window, M + 1
    int signals;   ///< rings: window signals, then partial derivatives
    int unknowns;  ///< columns without the known side
    algest::Solve solve;
    int solve_instants;
    S keep;
    S condition_limit;
    int kept;
    S deviation_limit;
    std::vector<S> tables;  ///< tables x samples, oldest sample first
    RowData<S> rows;
    RowData<S> perturbation;
    std::vector<int> noisy;   ///< inputs with noise
    std::vector<algest::NoiseChannel<S>> noise;
    std::vector<S> whiten_at;
    std::vector<S> noise_floor;
    std::vector<S> sizes;     ///< with a deviation limit: of the unknowns; else empty
    algest::LowPass<S> ratio;
    bool normalise;
    bool rows_published;
    int shortest;
    EliminationData<S> elimination = {};
    S margin_over_noise = S(0);
    int output = 0;
    S output_noise = S(0);
    PointRowData points = {};

    /// The arrays as the runtime reads them: valid until this object changes, moves or ends. Cost: none.
    algest::Blueprint<S> view() const {
        return {row_set(rows),
                solve,
                solve_instants,
                keep,
                condition_limit,
                kept,
                {static_cast<int>(noisy.size()), {noise.data(), static_cast<int>(noise.size())}},
                deviation_limit,
                {whiten_at.data(), static_cast<int>(whiten_at.size())},
                ratio,
                row_set(perturbation),
                normalise,
                elimination.view(),
                rows_published,
                shortest,
                {noise_floor.data(), static_cast<int>(noise_floor.size())},
                {sizes.data(), static_cast<int>(sizes.size())},
                margin_over_noise,
                static_cast<std::uint16_t>(output),
                output_noise,
                points.view()};
    }

private:
    algest::RowSet<S> row_set(const RowData<S>& of) const {
        return {samples,
                signals,
                of.rows,
                unknowns,
                {tables.data(), static_cast<int>(tables.size())},
                {of.functionals.data(), static_cast<int>(of.functionals.size())},
                {of.terms.data(), static_cast<int>(of.terms.size())}};
    }
};

/// The arrays behind a MomentSet; A: what moments are summed in.
template <class S, class A>
struct MomentData {
    int degree;
    S step;
    std::vector<unsigned char> degrees;
    std::vector<A> coefficients;
    std::vector<algest::WindowEnds<S>> ends;
    std::vector<double> growing;
    std::vector<double> growing_newest;
    std::vector<unsigned char> derivatives;   ///< empty: windows do not grow

    /// Valid until this object changes, moves or ends. Cost: none.
    algest::MomentSet<S, A> view() const {
        return {degree, step, {degrees.data(), static_cast<int>(degrees.size())}, {coefficients.data(), static_cast<int>(coefficients.size())}, {ends.data(), static_cast<int>(ends.size())}};
    }
    algest::GrowingSet growing_view() const {
        return {{growing.data(), static_cast<int>(growing.size())}, {growing_newest.data(), static_cast<int>(growing_newest.size())}, {derivatives.data(), static_cast<int>(derivatives.size())}};
    }
};

/// The plan must have moments, with accumulators of type A.
template <class S, class A>
MomentData<S, A> make_moments(const Plan& plan) {
    MomentData<S, A> data{plan.moments->degree, static_cast<S>(plan.moments->step), {}, {}, {}, {}, {}, {}};
    for (const int degree : plan.moments->degrees) data.degrees.push_back(static_cast<unsigned char>(degree));
    for (const MomentTable& table : plan.moments->tables) {
        for (std::size_t k = 0; k < table.coefficients.size(); ++k) {
            if constexpr (std::is_same_v<A, double>) data.coefficients.push_back(table.coefficients[k]);
            else data.coefficients.push_back({static_cast<S>(table.coefficients[k]), static_cast<S>(table.rests[k])});
        }
        data.ends.push_back({static_cast<S>(table.oldest), static_cast<S>(table.newest), static_cast<S>(table.of_one), static_cast<S>(table.gain), table.degree});
        if (plan.moments->shortest == 0) continue;
        data.growing.insert(data.growing.end(), table.growing.begin(), table.growing.end());
        data.growing_newest.insert(data.growing_newest.end(), table.growing_newest.begin(), table.growing_newest.end());
        data.derivatives.push_back(static_cast<unsigned char>(table.derivative));
    }
    return data;
}

/// Numbers of the plan are already rounded to its scalar, so converting them to that scalar changes nothing.
template <class S>
BlueprintData<S> make_blueprint(const Plan& plan) {
    const int unknowns = static_cast<int>(plan.lumped.size());
    BlueprintData<S> data{plan.samples(),
                          plan.rings(),
                          unknowns,
                          plan.solve,
                          plan.solve_instants,
                          static_cast<S>(plan.keep),
                          static_cast<S>(plan.condition_limit),
                          plan.kept,
                          static_cast<S>(plan.deviation_limit),
                          {},
                          make_rows<S>(plan.rows, unknowns),
                          make_rows<S>(plan.perturbation, unknowns),
                          {},
                          {},
                          {},
                          {},
                          {},
                          {},
                          plan.normalise,
                          plan.moments.has_value(),
                          plan.moments ? plan.moments->shortest : 0};
    data.tables.reserve(plan.tables.size() * static_cast<std::size_t>(plan.samples()));
    for (const Table& table : plan.tables) {
        for (const double weight : table.weights) data.tables.push_back(static_cast<S>(weight));
    }
    for (const NoiseChannel& channel : plan.noise) {
        if (data.noisy.empty() || data.noisy.back() != channel.input) data.noisy.push_back(channel.input);
        const int ring = static_cast<int>(plan.window_signals.size()) + channel.partial;
        data.noise.push_back({static_cast<std::uint16_t>(data.noisy.size() - 1), static_cast<std::uint16_t>(channel.signal),
                              channel.partial < 0 ? algest::no_partial : static_cast<std::uint16_t>(ring),
                              static_cast<std::uint16_t>(channel.lag), static_cast<S>(channel.factor)});
    }
    if (plan.whiten) {
        for (const Lumped& u : plan.lumped) data.whiten_at.push_back(static_cast<S>(u.initial));
    }
    for (const double x : plan.noise_floor) data.noise_floor.push_back(static_cast<S>(x));
    if (plan.deviation_limit > 0.0) {
        for (const Lumped& u : plan.lumped) if (!plan.elimination) data.sizes.push_back(std::isfinite(u.initial) ? static_cast<S>(std::abs(u.initial)) : S(0));
        for (const Parameter& p : plan.parameters) if (plan.elimination) data.sizes.push_back(static_cast<S>(std::abs(p.initial)));
    }
    data.elimination = make_elimination<S>(plan.elimination);
    data.margin_over_noise = static_cast<S>(plan.margin_over_noise);
    data.output = plan.output;
    data.output_noise = static_cast<S>(plan.output_noise);
    data.points = make_point_rows(plan);
    if (plan.ratio) {
        const auto s = [](double x) { return static_cast<S>(x); };
        const std::vector<double>& t = plan.ratio->transition;
        data.ratio = {true,
                      {s(t[0]), s(t[1]), s(t[2]), s(t[3])},
                      {s(plan.ratio->before[0]), s(plan.ratio->before[1])},
                      {s(plan.ratio->now[0]), s(plan.ratio->now[1])}};
    }
    return data;
}

}  // namespace algest::plan
