// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/operating_points.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "generator/blueprint.hpp"
#include "generator/tape.hpp"
#include "lab/whole_word.hpp"

namespace algest::lab {

namespace {

/// Means that differ by less than this part of the largest are the same: a sensor's noise moves the mean of a steady stretch by about as much, and
/// nobody who wants a second operating point sets a speed or a load that is so near to the first.
constexpr double same = 1e-3;

/// Of the quantity over the points: no wider than `same`, or than the four deviations that the rows must rise above (half of the tolerance each).
bool is_constant(const plan::Plan& plan, const OperatingPoints& points, std::size_t quantity) {
    double low = points.at(0, quantity);
    double high = low;
    for (std::size_t k = 1; k < points.count(); ++k) {
        low = std::min(low, points.at(k, quantity));
        high = std::max(high, points.at(k, quantity));
    }
    const double tolerance = plan.steady->averaged[quantity].tolerance;
    const double uncertain = plan.margin_over_noise > 0.0 && std::isfinite(tolerance) ? std::sqrt(plan.margin_over_noise) * tolerance / 2 : 0.0;
    return high - low <= std::max(uncertain, same * std::max(std::abs(low), std::abs(high))) && (low != 0.0 || high != 0.0);
}

/// Parameters of linear rows in the combinations that the points show no better than noise does, in words; empty: none, or not linear.
std::string not_above_noise(const plan::Plan& plan, const OperatingPoints& points) {
    if (plan.solve != Solve::least_squares || plan.margin_over_noise == 0.0) return "";
    constexpr double small = 0.2;   // of the largest part in a combination: what takes part by less does so by chance
    const auto blueprint = plan::make_blueprint<double>(plan);
    const RowSet<double> rows = blueprint.view().rows;
    const int n = rows.unknowns;
    std::vector<double> rings(static_cast<std::size_t>(ring_scalars(rows.signals, 1))), values(plan.signals.operations.size()), matrix(static_cast<std::size_t>(2 * row_entries(rows.rows, n)));
    std::vector<double> noise(static_cast<std::size_t>(packed_size(n)), 0.0), signals(plan.signals.results.size());
    Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t k = 0; k < points.count(); ++k) {
        plan::evaluate<double>(plan.signals, points.means.data() + k * points.quantities, nullptr, nullptr, values.data(), signals.data());
        write_sample(rings.data(), rows.signals, 1, 0, signals.data());
        double* const spare = matrix.data() + row_entries(rows.rows, n);
        evaluate_rows(rows, rings.data(), newest(1, 1, 0), matrix.data(), spare);
        for (int r = 0; r < rows.rows; ++r) {
            const Eigen::Map<const Eigen::RowVectorXd> row(matrix.data() + r * (n + 1), n);
            seen += row.transpose() * row;
        }
        add_noise(rows, blueprint.view().noise, rings.data(), newest(1, 1, 0), 1.0, spare, noise.data());
    }
    Eigen::MatrixXd of_noise(n, n);
    const Eigen::VectorXd size = seen.diagonal().cwiseSqrt();
    for (int i = 0; i < n; ++i) for (int j = 0; j < n; ++j) of_noise(i, j) = noise[static_cast<std::size_t>(packed_index(n, std::min(i, j), std::max(i, j)))] / size(i) / size(j);
    for (int i = 0; i < n; ++i) for (int j = 0; j < n; ++j) seen(i, j) /= size(i) * size(j);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(seen - plan.margin_over_noise * of_noise);
    if (solved.info() != Eigen::Success || !(solved.eigenvalues()(0) <= 0.0)) return "";
    std::vector<bool> open(static_cast<std::size_t>(n), false);
    for (int c = 0; c < n && solved.eigenvalues()(c) <= 0.0; ++c) {
        const Eigen::VectorXd direction = solved.eigenvectors().col(c).cwiseAbs();
        for (int u = 0; u < n; ++u) if (direction(u) > small * direction.maxCoeff()) open[static_cast<std::size_t>(u)] = true;
    }
    std::string out;
    for (const plan::Parameter& p : plan.parameters) {
        bool takes_part = false;
        for (std::size_t u = 0; u < open.size(); ++u) takes_part = takes_part || (open[u] && find_whole_word(plan.lumped[u].meaning, p.name) != std::string::npos);
        if (takes_part) out += (out.empty() ? "" : ", ") + p.name;
    }
    return out;
}

}  // namespace

const char* name(Standing standing) {
    switch (standing) {
        case Standing::best: return "best";
        case Standing::extremum: return "extremum";
        case Standing::unreal: return "unreal";
        case Standing::spurious: return "spurious";
    }
    return "?";
}

const char* in_words(Standing standing) {
    switch (standing) {
        case Standing::best: return "the estimate";
        case Standing::extremum: return "an extremum with a larger error";
        case Standing::unreal: return "a parameter's square is negative";
        case Standing::spurious: return "spurious: not a root of every extremum equation";
    }
    return "?";
}

std::vector<EliminationCandidate> named_candidates(const plan::Plan& plan, const std::vector<Candidate<double>>& candidates) {
    const auto rank = [](Standing v) { return v == Standing::best ? 0 : v == Standing::spurious ? 2 : 1; };
    std::vector<Candidate<double>> sorted = candidates;
    std::erase_if(sorted, [](const Candidate<double>& c) { return !std::isfinite(c.error); });   // roots that rounding sent to infinity
    std::stable_sort(sorted.begin(), sorted.end(), [&](const Candidate<double>& a, const Candidate<double>& b) {
        return std::make_tuple(a.stage, rank(a.standing), a.error) < std::make_tuple(b.stage, rank(b.standing), b.error);
    });
    std::vector<EliminationCandidate> out;
    for (const Candidate<double>& c : sorted) {
        const plan::EliminationStage& stage = plan.elimination->stages[static_cast<std::size_t>(c.stage)];
        EliminationCandidate named{"", {}, c.error, c.standing};
        for (const std::string& e : stage.equations) named.equations += (named.equations.empty() ? "" : ", ") + e;
        const auto add = [&](int parameter, bool squared, double value) {
            if (parameter < 0) return;
            const double size = plan.elimination->sizes[static_cast<std::size_t>(parameter)];
            named.values.push_back({plan.parameters[static_cast<std::size_t>(parameter)].name + (squared ? "^2" : ""), value * (squared ? size * size : size)});
        };
        add(stage.x, stage.x_squared, c.x);
        add(stage.y, stage.y_squared, c.y);
        out.push_back(std::move(named));
    }
    return out;
}

std::optional<std::string> what_is_missing(const plan::Plan& plan, const OperatingPoints& points, bool ok) {
    if (!plan.steady || ok) return std::nullopt;
    if (points.count() == 0) return "not identifiable from these data: no steady stretch of " + std::to_string(plan.steady->block) + " samples was found";
    std::string needs;
    for (std::size_t q = 0; q < points.quantities; ++q) {
        if (is_constant(plan, points, q)) needs += (needs.empty() ? "" : ", ") + plan.steady->averaged[q].name;
    }
    const std::string count = std::to_string(points.count()) + (points.count() == 1 ? " operating point" : " operating points");
    const std::string which = not_above_noise(plan, points);
    const std::string parameters = which.empty() ? "the parameters" : which;
    if (!needs.empty()) return "not identifiable from these data: " + (which.empty() ? "" : which + ": ") + "needs a second value of " + needs + ", the same at all of " + count;
    if (plan.margin_over_noise == 0.0) return "not identifiable from these data: " + count + " do not tell " + parameters + " apart";
    return "not identifiable from these data: " + count + " do not tell " + parameters + " apart by more than what their means are uncertain by (`noise`, and half of `steady`); spread speeds, currents and voltages further";
}

}  // namespace algest::lab
