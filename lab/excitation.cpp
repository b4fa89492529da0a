// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/excitation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <regex>
#include <utility>

#include "lab/confusion.hpp"
#include "lab/median.hpp"
#include "lab/noise.hpp"
#include "lab/plan_rows.hpp"
#include "lab/white_noise.hpp"

namespace algest::lab {

namespace {

constexpr int rows_a_window = 8;       ///< rows of overlapping windows say the same: an eighth of a window on they say something new
constexpr int most_instants = 4000;    ///< of the whole recording: a rank needs no more, and the rows take well below a second
constexpr double grows_by_noise = 1.05;   ///< of the length of a direction: noise is a tenth of its square, and least squares are off by a tenth there
constexpr double undetermined = 1e6;   ///< condition from which on a direction counts as not there: noise of one part in a million moves its value by all of it

/// Parameters that are computed from an unknown.
std::vector<std::string> followers(const plan::Plan& plan, const plan::Lumped& of) {
    std::vector<std::string> out;
    for (const plan::Parameter& p : plan.parameters) {
        const std::string between = " " + std::regex_replace(p.from, std::regex("[^A-Za-z0-9_]+"), " ") + " ";
        if (between.find(" " + of.name + " ") != std::string::npos) out.push_back(p.name);
    }
    return out;
}

/// "K needs omega different from zero"
std::string sentence(const plan::Plan& plan, const Confusion& c) {
    const auto unknown = std::find_if(plan.lumped.begin(), plan.lumped.end(), [&](const plan::Lumped& l) { return l.meaning == c.unknowns[0]; });
    if (c.unknowns.size() > 1 || unknown == plan.lumped.end()) return c.why;
    const std::vector<std::string> names = followers(plan, *unknown);
    double unsigned_factor = 1;
    const std::string need = fmt::format("{} {} {}", fmt::join(names, ", "), names.size() == 1 ? "needs" : "need", without_its_sign(regressor(plan, unknown - plan.lumped.begin()), unsigned_factor));
    return need + (c.hardly ? " to move unlike the other terms" : " different from zero");
}

/// By input of the plan: declared, else what it is rough by, jumps aside; what is held between samples is commanded and has none.
double noise_of(const model::Model& model, const plan::Input& input, const std::vector<double>& values) {
    const model::Signal* signal = model.signal(input.name);
    if (signal != nullptr && declares_noise(*signal)) return declared_noise(*signal);
    if (values.size() < 4 || (signal != nullptr && signal->hold == plan::Hold::zoh)) return 0;
    std::vector<double> third(values.size() - 3);
    for (std::size_t k = 0; k < third.size(); ++k) third[k] = std::abs(values[k + 3] - 3 * values[k + 2] + 3 * values[k + 1] - values[k]);
    return 1.4826 * *median(third) / std::sqrt(20.0);   // 1 + 9 + 9 + 1; of normal noise the median is 0.6745 sd
}

/// P of the recording, its sensors noisier by as much as they are, its columns in sizes of d's.
Eigen::MatrixXd noisier_rows(const model::Model& model, const plan::Plan& plan, std::vector<std::vector<double>> inputs, const Recording& recording, int stride, const Decomposition& d) {
    std::mt19937 random(1);   // NOLINT(cert-msc32-c,cert-msc51-cpp): the same answer on each run
    for (std::size_t i = 0; i < inputs.size(); ++i) add_white_noise(inputs[i], noise_of(model, plan.inputs[i], inputs[i]), random);
    return plan_rows(plan, ring_values(plan, inputs, recording.t, {0, recording.samples()}), stride).p * d.norm.cwiseInverse().asDiagonal();
}

}  // namespace

std::vector<std::string> missing_excitation(const model::Model& model, const plan::Plan& plan, const Recording& recording) {
    Diagnostics said_before;   // the plan was replayed
    std::vector<std::vector<double>> inputs;
    if (plan.steady || plan.discrete || plan.elimination || plan.decimate > 1 || !plan.past.empty() || !read_inputs(plan, recording, inputs, said_before)) return {};
    const RowRange all{0, recording.samples()};
    const Eigen::MatrixXd rings = ring_values(plan, inputs, recording.t, all);
    const int stride = std::max(1 + static_cast<int>(recording.samples()) / most_instants, plan.intervals / rows_a_window);
    const StackedRows rows = plan_rows(plan, rings, stride);
    if (rows.p.rows() < rows.p.cols() || !rows.p.allFinite() || !rows.q.allFinite()) return {};
    const Decomposition d = decompose(rows, undetermined);
    const Eigen::MatrixXd noisier = noisier_rows(model, plan, inputs, recording, stride, d);
    std::vector<std::string> out;
    for (const Confusion& c : confusions(plan, d, covariance(rows, d, correlated_instants(rows.p * d.solution - rows.q, rows)))) {
        const bool seen = c.direction >= 0 && (noisier * d.right.col(c.direction)).norm() < grows_by_noise * d.singular(c.direction);
        const std::string text = sentence(plan, c);
        if (!seen && std::find(out.begin(), out.end(), text) == out.end()) out.push_back(text);
    }
    return out;
}

}  // namespace algest::lab
