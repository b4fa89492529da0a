// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/batch.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "algest/rows.hpp"
#include "generator/blueprint.hpp"
#include "generator/tape.hpp"
#include "lab/parabola_derivative.hpp"

namespace algest::lab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// [P|Q] of every instant, one below the other.
struct Stack {
    MatrixXd p;
    VectorXd q;
    Eigen::Index rows;   ///< an instant
    Eigen::Index instants() const { return p.rows() / rows; }
};

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

/// Values of the plan's rings at every sample, one sample a column.
MatrixXd ring_values(const plan::Plan& plan, const std::vector<std::vector<double>>& inputs, const std::vector<double>& t, RowRange rows) {
    std::vector<std::vector<double>> samples;
    std::vector<std::vector<double>> derivatives(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto first = inputs[i].begin() + static_cast<std::ptrdiff_t>(rows.begin) + plan.longest_wait() - plan.inputs[i].wait;
        samples.emplace_back(first, first + static_cast<std::ptrdiff_t>(t.size()));
        if (plan.inputs[i].differentiated) derivatives[i] = parabola_derivative(t, samples[i]).derivative;
    }
    MatrixXd out(plan.rings(), static_cast<Eigen::Index>(t.size()));
    std::vector<double> here(inputs.size());
    std::vector<double> slope(inputs.size());
    std::vector<double> values(plan.signals.operations.size());
    for (std::size_t k = 0; k < t.size(); ++k) {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            here[i] = samples[i][k];
            if (!derivatives[i].empty()) slope[i] = derivatives[i][k];
        }
        plan::evaluate(plan.signals, here.data(), here.data(), slope.data(), values.data(), out.col(static_cast<Eigen::Index>(k)).data());
    }
    return out;
}

/// Rows of instants at which a signal is not finite are left out, as the estimator refuses such samples.
Stack stack(const plan::Plan& plan, const MatrixXd& rings) {
    const auto blueprint = plan::make_blueprint<double>(plan);
    const RowSet<double> set = blueprint.view().rows;
    const Eigen::Index width = set.unknowns + 1;
    std::vector<double> all;
    std::vector<double> window(static_cast<std::size_t>(ring_scalars(set.signals, set.samples)));
    std::vector<double> matrix(static_cast<std::size_t>(set.rows) * static_cast<std::size_t>(width));
    int filled = 0;
    for (Eigen::Index k = 0; k < rings.cols(); ++k) {
        if (!rings.col(k).allFinite()) {
            filled = 0;
            continue;
        }
        write_sample(window.data(), set.signals, set.samples, static_cast<int>(k % set.samples), rings.col(k).data());
        if (++filled < set.samples) continue;
        evaluate_rows(set, window.data(), newest(set.samples, set.samples, static_cast<int>((k + 1) % set.samples)), matrix.data());
        all.insert(all.end(), matrix.begin(), matrix.end());
    }
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> both(all.data(), static_cast<Eigen::Index>(all.size()) / width, width);
    return {both.leftCols(width - 1), both.rightCols(1), set.rows};
}

/// P with columns of norm 1, taken apart.
struct Decomposition {
    VectorXd norm;       ///< of the columns; 1 for one of zeros
    VectorXd singular;   ///< values, largest first
    MatrixXd right;      ///< singular vectors, one a column
    Eigen::Index rank;
    VectorXd solution;   ///< of the unknowns, the shortest in scaled ones
};

Decomposition decompose(const Stack& of, double condition_limit) {
    Decomposition out;
    out.norm = of.p.colwise().norm();
    for (double& n : out.norm) n = n > 0.0 ? n : 1.0;
    const Eigen::HouseholderQR<MatrixXd> qr(of.p * out.norm.cwiseInverse().asDiagonal());
    const Eigen::Index n = of.p.cols();
    const MatrixXd upper = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
    const VectorXd right_side = (qr.householderQ().adjoint() * of.q).head(n);
    const Eigen::JacobiSVD<MatrixXd> svd(upper, Eigen::ComputeFullU | Eigen::ComputeFullV);
    out.singular = svd.singularValues();
    out.right = svd.matrixV();
    out.rank = (out.singular.array() * condition_limit > out.singular(0)).count();
    VectorXd coordinates = svd.matrixU().adjoint() * right_side;
    for (Eigen::Index i = 0; i < n; ++i) coordinates(i) = i < out.rank ? coordinates(i) / out.singular(i) : 0.0;
    out.solution = (out.right * coordinates).cwiseQuotient(out.norm);
    return out;
}

/// Andrews (1991): for residuals that go like e_k = rho e_(k-1) + noise, Bartlett weights over this many instants.
double correlated_instants(const VectorXd& residuals, const Stack& of) {
    double most = 0.0;
    for (Eigen::Index r = 0; r < of.rows; ++r) {
        double here = 0.0;
        double next = 0.0;
        for (Eigen::Index k = 0; k + 1 < of.instants(); ++k) {
            here += residuals(k * of.rows + r) * residuals(k * of.rows + r);
            next += residuals(k * of.rows + r) * residuals((k + 1) * of.rows + r);
        }
        const double rho = here > 0.0 ? std::clamp(next / here, -0.99, 0.99) : 0.0;
        const double curvature = 2.0 * rho / (1.0 - rho * rho);
        most = std::max(most, 1.1447 * std::cbrt(curvature * curvature * static_cast<double>(of.instants())));
    }
    return std::min(most, static_cast<double>(of.instants()) / 4.0);
}

/// Covariance of the unknowns in the directions that are determined, 0 in the others.
MatrixXd covariance(const Stack& of, const Decomposition& d, double memory) {
    const VectorXd residuals = of.p * d.solution - of.q;
    MatrixXd scores(of.p.cols(), of.instants());   // P'e of each instant, columns of P at norm 1
    for (Eigen::Index k = 0; k < of.instants(); ++k) {
        scores.col(k) = d.norm.cwiseInverse().asDiagonal() * (of.p.middleRows(k * of.rows, of.rows).transpose() * residuals.segment(k * of.rows, of.rows));
    }
    MatrixXd sum = scores * scores.transpose();
    for (Eigen::Index lag = 1; static_cast<double>(lag) < memory; ++lag) {
        const MatrixXd cross = scores.rightCols(of.instants() - lag) * scores.leftCols(of.instants() - lag).transpose();
        sum += (1.0 - static_cast<double>(lag) / memory) * (cross + cross.transpose());
    }
    const MatrixXd kept = d.right.leftCols(d.rank);
    const MatrixXd inverse = kept * d.singular.head(d.rank).array().square().inverse().matrix().asDiagonal() * kept.transpose();
    const auto unscale = d.norm.cwiseInverse().asDiagonal();
    return unscale * inverse * sum * inverse * unscale;
}

/// What the unknown multiplies, in the first row that has it.
std::string regressor(const plan::Plan& plan, Eigen::Index unknown) {
    std::string out;
    for (const plan::Row& row : plan.rows) {
        for (const plan::RowTerm& term : row.terms) {
            if (term.lumped != unknown) continue;
            const std::string signal = term.signal < 0 ? "1" : plan.window_signals[static_cast<std::size_t>(term.signal)].text;
            const std::string factor = term.coefficient == "1" ? "" : term.coefficient == "-1" ? "-" : term.coefficient + "*";
            out += (out.empty() ? "" : " + ") + factor + signal;
        }
        if (!out.empty()) break;
    }
    return out;
}

std::string plus(double factor, const std::string& name) {
    const std::string size = fmt::format("{:.4g}", std::abs(factor));
    return fmt::format(" {} {}{}", factor < 0.0 ? "-" : "+", size == "1" ? "" : size + "*", name);
}

/// Directions spanned by the columns of `of`, each in as few unknowns as may be: one a row, by elimination with the largest pivots.
MatrixXd sparse_directions(const MatrixXd& of) {
    MatrixXd out = of.transpose();
    for (Eigen::Index r = 0; r < out.rows(); ++r) {
        Eigen::Index row = 0;
        Eigen::Index column = 0;
        out.bottomRows(out.rows() - r).cwiseAbs().maxCoeff(&row, &column);
        out.row(r).swap(out.row(r + row));
        out.row(r) /= out(r, column);
        for (Eigen::Index other = 0; other < out.rows(); ++other) if (other != r) out.row(other) -= out(other, column) * out.row(r);
    }
    return out;
}

/// An entry of an undetermined direction below this is rounding and noise: what it stands for is determined.
constexpr double negligible = 1e-2;
/// Of a direction that is hardly determined: what takes part in it by less than this does so by chance.
constexpr double small = 0.2;

Confusion confusion(const plan::Plan& plan, const Decomposition& d, const MatrixXd& of_solution, const Eigen::RowVectorXd& direction, bool hardly) {
    Confusion out{hardly, {}, {}};
    const std::string apart = hardly ? "can hardly be told apart" : "cannot be told apart";
    const std::string throughout = hardly ? "almost throughout" : "throughout";
    std::vector<Eigen::Index> involved;
    for (Eigen::Index u = 0; u < direction.size(); ++u) {
        if (std::abs(direction(u)) < (hardly ? small : negligible) * direction.cwiseAbs().maxCoeff()) continue;
        involved.push_back(u);
        out.unknowns.push_back(plan.lumped[static_cast<std::size_t>(u)].meaning);
    }
    if (involved.size() == 1) {
        out.text = fmt::format("{}: what it multiplies, {}, is {}", out.unknowns[0], regressor(plan, involved[0]), hardly ? "nearly a sum of the others" : "zero throughout");
    } else if (involved.size() == 2) {
        const Eigen::Index a = involved[0];
        const Eigen::Index b = involved[1];
        const double ratio = -direction(a) * d.norm(b) / (direction(b) * d.norm(a));   // of the second column to the first
        const double value = d.solution(a) + ratio * d.solution(b);
        const double sd = std::sqrt(std::max(0.0, of_solution(a, a) + 2.0 * ratio * of_solution(a, b) + ratio * ratio * of_solution(b, b)));
        out.text = fmt::format("{} and {} {}: {} is {:.3g} times {} {}; determined is {}{} = {:.4g}, sd {:.2g}", out.unknowns[0], out.unknowns[1], apart,
                               regressor(plan, b), ratio, regressor(plan, a), throughout, out.unknowns[0], plus(ratio, out.unknowns[1]), value, sd);
    } else {
        std::string names;
        std::string sum;
        for (std::size_t i = 0; i < involved.size(); ++i) {
            names += (i == 0 ? "" : i + 1 == involved.size() ? " and " : ", ") + out.unknowns[i];
            const double part = direction(involved[i]) / d.norm(involved[i]) * d.norm(involved[0]) / direction(involved[0]);
            sum += i == 0 ? "(" + regressor(plan, involved[i]) + ")" : plus(part, "(" + regressor(plan, involved[i]) + ")");
        }
        out.text = fmt::format("{} {}: {} is zero {}", names, apart, sum, throughout);
    }
    return out;
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
    const Stack all = stack(plan, ring_values(plan, inputs, instants(plan, recording, rows), rows));
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
    const MatrixXd open = sparse_directions(d.right.rightCols(unknowns - d.rank));
    for (Eigen::Index r = 0; r < open.rows(); ++r) out.confusions.push_back(confusion(plan, d, of_solution, open.row(r), false));
    for (Eigen::Index i = 0; i < d.rank; ++i) {
        if (d.singular(0) > dependent_columns * d.singular(i)) out.confusions.push_back(confusion(plan, d, of_solution, d.right.col(i).transpose(), true));
    }
    return out;
}

}  // namespace algest::lab
