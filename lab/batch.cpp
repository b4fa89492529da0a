// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/tape.hpp"
#include "lab/plan_rows.hpp"

namespace algest::lab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool check(const plan::Plan& plan, const Recording& recording, RowRange rows, Diagnostics& diagnostics) {
    if (plan.functional != plan::Functional::derivative || plan.solve != Solve::least_squares) {
        diagnostics.error(plan.name, {}, "a batch is for rows of single instants", "functional = \"derivative\" and solve = \"least_squares\" in the model, or replay without --batch");
    }
    const std::size_t needed = 3 + static_cast<std::size_t>(plan.longest_wait());
    if (rows.size() < needed) diagnostics.error(recording.file, {static_cast<int>(rows.end) + 1, 1}, fmt::format("{} samples, and the parabola filter needs {}", rows.size(), needed), "a longer stretch");
    if (plan.longest_wait() > 0 && !recording.uniform) {
        diagnostics.error(recording.file, {1, recording.time_place}, "the steps of `t` differ, and a `lag` counts equal ones", "steps that are equal, or signals without lag");
    }
    if (plan.intervals > 0 && !recording.uniform) {
        diagnostics.error(recording.file, {1, recording.time_place}, "the steps of `t` differ, and what a held signal does between them is not known",
                          "steps that are equal, or hold = \"linear\" for the signals of the model");
    }
    return !diagnostics.has_errors();
}

/// Instants of the filter: multiples of the period where steps are equal, since their decimals would be noise.
std::vector<double> instants(const plan::Plan& plan, const Recording& recording, RowRange rows) {
    std::vector<double> t(recording.t.begin() + static_cast<std::ptrdiff_t>(rows.begin), recording.t.begin() + static_cast<std::ptrdiff_t>(rows.end) - plan.longest_wait());
    if (recording.uniform) for (std::size_t k = 0; k < t.size(); ++k) t[k] = static_cast<double>(k) * recording.period;
    return t;
}

/// Values, gradients in the unknowns (one parameter a row).
struct Mapped {
    std::vector<double> values;
    MatrixXd gradient;
};

Mapped map_parameters(const plan::Plan& plan, const VectorXd& unknowns) {
    Mapped out{std::vector<double>(plan.parameter_map.results.size()), {}};
    std::vector<double> scratch(std::max(plan.parameter_map.operations.size(), plan.map_derivatives.operations.size()));
    std::vector<double> derivatives(plan.map_derivatives.results.size());
    plan::evaluate<double>(plan.parameter_map, unknowns.data(), nullptr, nullptr, scratch.data(), out.values.data());
    plan::evaluate<double>(plan.map_derivatives, unknowns.data(), nullptr, nullptr, scratch.data(), derivatives.data());
    out.gradient = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(derivatives.data(), plan.estimated(), unknowns.size());
    return out;
}

BatchParameter parameter(const Mapped& mapped, Eigen::Index p, const Decomposition& d, const MatrixXd& of_solution) {
    const Eigen::RowVectorXd gradient = mapped.gradient.row(p);
    const Eigen::RowVectorXd scaled = gradient.cwiseQuotient(d.norm.transpose());
    const double open = (scaled * d.right.rightCols(d.right.cols() - d.rank)).norm();
    const double value = mapped.values[static_cast<std::size_t>(p)];
    if (open > negligible * scaled.norm() || !std::isfinite(value)) return {};
    const double variance = gradient * of_solution * gradient.transpose();
    return {value, std::isfinite(variance) ? std::optional(std::sqrt(std::max(0.0, variance))) : std::nullopt};
}

}  // namespace

std::optional<Batch> batch(const plan::Plan& plan, const Recording& recording, const Stretch& stretch, Diagnostics& diagnostics) {
    const RowRange rows = rows_of(recording, stretch);
    std::vector<std::vector<double>> inputs;
    if (!check(plan, recording, rows, diagnostics) || !read_inputs(plan, recording, inputs, diagnostics)) return std::nullopt;
    const StackedRows all = plan_rows(plan, ring_values(plan, inputs, instants(plan, recording, rows), rows), 1);
    const Eigen::Index unknowns = static_cast<Eigen::Index>(plan.lumped.size());
    if (all.p.rows() < unknowns || !all.p.allFinite() || !all.q.allFinite()) {
        diagnostics.error(recording.file, {1, 1}, fmt::format("{} rows for {} unknowns", all.p.allFinite() ? all.p.rows() : 0, unknowns), "a longer stretch, and formulas that are finite on it");
        return std::nullopt;
    }
    const Decomposition d = decompose(all, plan.condition_limit);
    Batch out{rows.size(), static_cast<std::size_t>(all.instants()), recording.uniform, {}, 0.0, 0.0, {}};
    out.condition = d.singular(unknowns - 1) > 0.0 ? d.singular(0) / d.singular(unknowns - 1) : std::numeric_limits<double>::infinity();
    out.memory = correlated_instants(all.p * d.solution - all.q, all);
    const MatrixXd of_solution = covariance(all, d, out.memory);
    const Mapped mapped = map_parameters(plan, d.solution);
    for (Eigen::Index p = 0; p < plan.estimated(); ++p) out.parameters.push_back(parameter(mapped, p, d, of_solution));
    out.confusions = confusions(plan, d, of_solution);
    return out;
}

}  // namespace algest::lab
