// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/confusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace algest::lab {

std::string regressor(const plan::Plan& plan, Eigen::Index unknown) {
    std::string out;
    for (const plan::Row& row : plan.rows) {
        for (const plan::RowTerm& term : row.terms) {
            if (term.lumped != unknown) continue;
            const std::string signal = term.signal < 0 ? "1" : plan.window_signals[static_cast<std::size_t>(term.signal)].text;
            const bool negative = term.coefficient.front() == '-';
            const std::string size = term.coefficient.substr(negative ? 1 : 0);
            out += (negative ? out.empty() ? "-" : " - " : out.empty() ? "" : " + ") + (size == "1" ? signal : size + "*" + signal);
        }
        if (!out.empty()) break;
    }
    return out;
}

std::string without_its_sign(const std::string& regressor, double& factor) {
    if (regressor.front() != '-' || regressor.find(' ') != std::string::npos) return regressor;
    factor = -factor;
    return regressor.substr(1);
}

namespace {

using Eigen::MatrixXd;

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

/// Of a direction that is hardly determined: what takes part in it by less than this does so by chance.
constexpr double small = 0.2;

Confusion confusion(const plan::Plan& plan, const Decomposition& d, const MatrixXd& of_solution, const Eigen::RowVectorXd& direction, bool hardly) {
    Confusion out{hardly, {}, {}, {}, -1};
    const std::string apart = hardly ? "can hardly be told apart" : "cannot be told apart";
    const std::string throughout = hardly ? "almost throughout" : "throughout";
    std::vector<Eigen::Index> involved;
    for (Eigen::Index u = 0; u < direction.size(); ++u) {
        if (std::abs(direction(u)) < (hardly ? small : negligible) * direction.cwiseAbs().maxCoeff()) continue;
        involved.push_back(u);
        out.unknowns.push_back(plan.lumped[static_cast<std::size_t>(u)].meaning);
    }
    if (involved.size() == 1) {
        double unsigned_factor = 1;
        out.why = fmt::format("{}: what it multiplies, {}, is {}", out.unknowns[0], without_its_sign(regressor(plan, involved[0]), unsigned_factor), hardly ? "nearly a sum of the others" : "zero throughout");
    } else if (involved.size() == 2) {
        const Eigen::Index a = involved[0];
        const Eigen::Index b = involved[1];
        const double ratio = -direction(a) * d.norm(b) / (direction(b) * d.norm(a));   // of the second column to the first
        const double value = d.solution(a) + ratio * d.solution(b);
        const double sd = std::sqrt(std::max(0.0, of_solution(a, a) + 2.0 * ratio * of_solution(a, b) + ratio * ratio * of_solution(b, b)));
        double times = ratio;
        const std::string first = without_its_sign(regressor(plan, a), times);
        const std::string second = without_its_sign(regressor(plan, b), times);
        out.why = fmt::format("{} and {} {}: {} is {:.3g} times {} {}", out.unknowns[0], out.unknowns[1], apart, second, times, first, throughout);
        out.determined = fmt::format("determined is {}{} = {:.4g}, sd {:.2g}", out.unknowns[0], plus(ratio, out.unknowns[1]), value, sd);
    } else {
        std::string names;
        std::string sum;
        for (std::size_t i = 0; i < involved.size(); ++i) {
            names += (i == 0 ? "" : i + 1 == involved.size() ? " and " : ", ") + out.unknowns[i];
            const double part = direction(involved[i]) / d.norm(involved[i]) * d.norm(involved[0]) / direction(involved[0]);
            sum += i == 0 ? "(" + regressor(plan, involved[i]) + ")" : plus(part, "(" + regressor(plan, involved[i]) + ")");
        }
        out.why = fmt::format("{} {}: {} is zero {}", names, apart, sum, throughout);
    }
    return out;
}

}  // namespace

std::vector<Confusion> confusions(const plan::Plan& plan, const Decomposition& d, const MatrixXd& of_solution) {
    std::vector<Confusion> out;
    const MatrixXd open = sparse_directions(d.right.rightCols(d.right.cols() - d.rank));
    for (Eigen::Index r = 0; r < open.rows(); ++r) out.push_back(confusion(plan, d, of_solution, open.row(r), false));
    for (Eigen::Index i = 0; i < d.rank; ++i) {
        if (d.singular(0) <= dependent_columns * d.singular(i)) continue;
        out.push_back(confusion(plan, d, of_solution, d.right.col(i).transpose(), true));
        out.back().direction = i;
    }
    return out;
}

}  // namespace algest::lab
