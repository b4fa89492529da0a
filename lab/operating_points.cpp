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

/// All rows of the points, and what the errors of their means make of them, as the runtime sums it.
struct Pooled {
    std::vector<double> triangle, sums, moments;
};

Pooled pool(const Blueprint<double>& blueprint, const plan::Plan& plan, const OperatingPoints& points) {
    const auto sized = [](int count) { return std::vector<double>(static_cast<std::size_t>(count), 0.0); };
    const RowSet<double>& rows = blueprint.rows;
    const int n = rows.unknowns;
    Pooled out{sized(triangle_scalars(n)), sized(point_noise_scalars(n, blueprint.points.groups)), sized(point_moments(blueprint.points))};
    auto rings = sized(ring_scalars(rows.signals, 1)), matrix = sized(row_entries(rows.rows, n)), spare = sized(row_entries(rows.rows, n) + all_change_products(blueprint.points));
    std::vector<double> values(plan.signals.operations.size()), signals(plan.signals.results.size());
    for (std::size_t k = 0; k < points.count(); ++k) {
        plan::evaluate<double>(plan.signals, points.means.data() + k * points.quantities, nullptr, nullptr, values.data(), signals.data());
        write_sample(rings.data(), rows.signals, 1, 0, signals.data());
        const WindowPosition at = newest(1, 1, 0);
        evaluate_rows(rows, rings.data(), at, matrix.data(), spare.data());
        if (!all_finite(matrix.data(), row_entries(rows.rows, n))) continue;
        add_point(rows, blueprint.noise, blueprint.points, rings.data(), at, blueprint.keep, matrix.data(), spare.data(), out.sums.data(), out.moments.data());
        add_rows(out.triangle.data(), matrix.data(), rows.rows, n, blueprint.keep);
        add_residuals(blueprint.points, matrix.data(), n, out.sums.data());
    }
    return out;
}

/// What the columns do with what is solved for (columns x solved), where the points are solved without a test against noise; and how many times the residuals
/// are what noise explains. Empty: the columns depend on each other.
struct Solution {
    Eigen::MatrixXd slopes;
    double excess = 1.0;
};

std::optional<Solution> solve(const Blueprint<double>& blueprint, const Pooled& pooled) {
    const int n = blueprint.rows.unknowns;
    const int solved = point_parameters(blueprint.elimination, n);
    std::vector<double> scratch(static_cast<std::size_t>(point_scratch(blueprint))), theta(static_cast<std::size_t>(solved));
    Solution out{Eigen::MatrixXd::Identity(n, n)};
    if (blueprint.elimination.parameters == 0) {
        if (!solve_triangle(pooled.triangle.data(), n, scratch.data(), theta.data()).regular) return std::nullopt;
        out.excess = residual_excess(pooled.sums[static_cast<std::size_t>(group_place(n, 0) + 1)], expected_residuals(pooled.sums.data(), n, 0, 0, n, theta.data()));
        return out;
    }
    if (!eliminate(blueprint.elimination, pooled.triangle.data(), n, scratch.data(), theta.data(), NoiseMargin<double>{nullptr, 0.0}).regular) return std::nullopt;
    const NoiseMargin<double> noise{pooled.sums.data(), blueprint.margin_over_noise, &out.excess};
    (void)eliminate(blueprint.elimination, pooled.triangle.data(), n, scratch.data(), theta.data(), noise);
    for (int p = 0; p < solved; ++p) theta[static_cast<std::size_t>(p)] /= blueprint.elimination.sizes[p];
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> slopes(n, solved);
    detail::columns_at(blueprint.elimination, theta.data(), n, scratch.data(), slopes.data());
    out.slopes = slopes;
    return out;
}

/// What takes part in the combinations that the points show no better than noise does; by what is solved for.
std::vector<bool> not_above_noise(const Eigen::MatrixXd& seen, const Eigen::MatrixXd& of_noise) {
    constexpr double small = 0.2;   // of the largest part in a combination: what takes part by less does so by chance
    const Eigen::VectorXd size = seen.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(size.asDiagonal() * (seen - of_noise) * size.asDiagonal());
    std::vector<bool> out(static_cast<std::size_t>(seen.rows()), false);
    for (Eigen::Index c = 0; solved.info() == Eigen::Success && c < seen.rows() && solved.eigenvalues()(c) <= 0.0; ++c) {
        const Eigen::VectorXd direction = solved.eigenvectors().col(c).cwiseAbs();
        for (Eigen::Index u = 0; u < seen.rows(); ++u) if (direction(u) > small * direction.maxCoeff()) out[static_cast<std::size_t>(u)] = true;
    }
    return out;
}

/// By what is solved for: the unknowns, or with an elimination the parameters, stage after stage.
std::vector<bool> not_above_noise(const plan::Plan& plan, const Blueprint<double>& blueprint, const Pooled& pooled, const Solution& at) {
    const int n = blueprint.rows.unknowns;
    Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(n, n), noise(n, n);
    for (int i = 0; i < n; ++i) {
        for (int j = i; j < n; ++j) {
            triangle(i, j) = pooled.triangle[static_cast<std::size_t>(packed_index(n + 1, i, j))];
            noise(i, j) = noise(j, i) = plan.margin_over_noise * at.excess * pooled.sums[static_cast<std::size_t>(packed_index(n, i, j))];
        }
    }
    if (!plan.elimination) return not_above_noise(triangle.transpose() * triangle, noise);
    std::vector<bool> out(plan.parameters.size(), false);
    for (const plan::EliminationStage& stage : plan.elimination->stages) {
        std::vector<Eigen::Index> own;
        for (const plan::EliminationAlone& a : stage.alone) own.push_back(a.parameter);
        for (const int p : {stage.x, stage.y}) if (p >= 0) own.push_back(p);
        const Eigen::MatrixXd slopes = at.slopes(Eigen::seqN(stage.first_column, stage.columns), own);
        const auto block = [&](const Eigen::MatrixXd& of) { return of.block(stage.first_column, stage.first_column, stage.columns, stage.columns); };
        const Eigen::MatrixXd changes = block(triangle) * slopes;
        const std::vector<bool> open = not_above_noise(changes.transpose() * changes, slopes.transpose() * block(noise) * slopes);
        for (std::size_t k = 0; k < own.size(); ++k) if (open[k]) out[static_cast<std::size_t>(own[k])] = true;
    }
    return out;
}

/// Parameters in the combinations that the points show no better than noise does, in words; empty: none.
std::string not_above_noise(const plan::Plan& plan, const OperatingPoints& points) {
    if (!plan.points_above_noise()) return "";
    const auto data = plan::make_blueprint<double>(plan);
    const Blueprint<double> blueprint = data.view();
    const Pooled pooled = pool(blueprint, plan, points);
    const auto at = solve(blueprint, pooled);
    if (!at) return "";
    const std::vector<bool> open = not_above_noise(plan, blueprint, pooled, *at);
    std::string out;
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        bool takes_part = plan.elimination && open[p];
        for (std::size_t u = 0; !plan.elimination && u < open.size(); ++u) takes_part = takes_part || (open[u] && find_whole_word(plan.lumped[u].meaning, plan.parameters[p].name) != std::string::npos);
        if (takes_part) out += (out.empty() ? "" : ", ") + plan.parameters[p].name;
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
