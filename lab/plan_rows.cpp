// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/plan_rows.hpp"

#include "algest/rows.hpp"
#include "generator/blueprint.hpp"
#include "generator/tape.hpp"
#include "lab/parabola_derivative.hpp"

namespace algest::lab {

using Eigen::MatrixXd;

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

StackedRows plan_rows(const plan::Plan& plan, const MatrixXd& rings, int stride) {
    const auto blueprint = plan::make_blueprint<double>(plan);
    const RowSet<double> set = blueprint.view().rows;
    const Eigen::Index width = set.unknowns + 1;
    std::vector<double> all;
    std::vector<double> window(static_cast<std::size_t>(ring_scalars(set.signals, set.samples)));
    std::vector<double> matrix(static_cast<std::size_t>(row_entries(set.rows, set.unknowns)));
    std::vector<double> scratch(matrix.size());
    int filled = 0;
    for (Eigen::Index k = 0; k < rings.cols(); ++k) {
        if (!rings.col(k).allFinite()) {
            filled = 0;
            continue;
        }
        write_sample(window.data(), set.signals, set.samples, static_cast<int>(k % set.samples), rings.col(k).data());
        if (++filled < set.samples || (filled - set.samples) % stride != 0) continue;
        evaluate_rows(set, window.data(), newest(set.samples, set.samples, static_cast<int>((k + 1) % set.samples)), matrix.data(), scratch.data());
        all.insert(all.end(), matrix.begin(), matrix.end());
    }
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> both(all.data(), static_cast<Eigen::Index>(all.size()) / width, width);
    return {both.leftCols(width - 1), both.rightCols(1), set.rows};
}

}  // namespace algest::lab
