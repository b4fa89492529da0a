// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/excitation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>

#include "lab/confusion.hpp"
#include "lab/plan_rows.hpp"

namespace algest::lab {

namespace {

constexpr int rows_a_window = 8;       ///< rows of overlapping windows say the same: an eighth of a window on they say something new
constexpr int most_instants = 4000;    ///< of the whole recording: a rank needs no more, and the rows take well below a second
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
    if (c.unknowns.size() > 1 || unknown == plan.lumped.end()) return c.text;
    const std::vector<std::string> names = followers(plan, *unknown);
    const std::string need = fmt::format("{} {} {}", fmt::join(names, ", "), names.size() == 1 ? "needs" : "need", regressor(plan, unknown - plan.lumped.begin()));
    return need + (c.hardly ? " to move unlike the other terms" : " different from zero");
}

}  // namespace

std::vector<std::string> missing_excitation(const plan::Plan& plan, const Recording& recording) {
    Diagnostics said_before;   // the plan was replayed
    std::vector<std::vector<double>> inputs;
    if (plan.steady || plan.discrete || plan.elimination || plan.decimate > 1 || !plan.past.empty() || !read_inputs(plan, recording, inputs, said_before)) return {};
    const RowRange all{0, recording.samples()};
    const Eigen::MatrixXd rings = ring_values(plan, inputs, recording.t, all);
    const StackedRows rows = plan_rows(plan, rings, std::max(1 + static_cast<int>(recording.samples()) / most_instants, plan.intervals / rows_a_window));
    if (rows.p.rows() < rows.p.cols() || !rows.p.allFinite() || !rows.q.allFinite()) return {};
    const Decomposition d = decompose(rows, undetermined);
    std::vector<std::string> out;
    for (const Confusion& c : confusions(plan, d, covariance(rows, d, correlated_instants(rows.p * d.solution - rows.q, rows)))) out.push_back(sentence(plan, c));
    return out;
}

}  // namespace algest::lab
