// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/stuck_sensor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace algest::lab {

namespace {

constexpr std::size_t fewest = 50;        ///< samples of a window, at least
constexpr std::size_t longer = 5;         ///< than any other run: a coarse sensor stands at each of its steps
constexpr double as_elsewhere = 0.5;      ///< of a signal's rms change from sample to sample: it moves

using Samples = std::vector<double>;

void add_differentiated(const formula::Formula& f, std::set<std::string>& out) {
    if (formula::is_derivative(f)) out.insert(f->arguments[0]->name);
    for (const formula::Formula& a : f->arguments) add_differentiated(a, out);
}

/// Of equal samples, [begin, end).
struct Run {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t size() const { return end - begin; }
};

/// The longest of the rows, and how long the next one is.
std::pair<Run, std::size_t> longest(const Samples& x, RowRange rows) {
    Run best;
    std::size_t next = 0;
    for (Run run{rows.begin, rows.begin}; run.begin < rows.end; run = {run.end, run.end}) {
        while (run.end < rows.end && x[run.end] == x[run.begin]) ++run.end;
        if (run.size() > best.size()) {
            next = best.size();
            best = run;
        } else {
            next = std::max(next, run.size());
        }
    }
    return {best, next};
}

/// Rms of the changes from sample to sample.
double motion(const Samples& x, std::size_t begin, std::size_t end) {
    double squares = 0;
    for (std::size_t k = begin + 1; k < end; ++k) squares += (x[k] - x[k - 1]) * (x[k] - x[k - 1]);
    return end > begin + 1 ? std::sqrt(squares / static_cast<double>(end - begin - 1)) : 0.0;
}

}  // namespace

std::optional<std::string> stuck_sensor(const model::Model& model, const plan::Plan& plan, const Recording& recording, const Stretch& stretch) {
    Diagnostics said_before;   // the plan was replayed
    std::vector<Samples> inputs;
    const RowRange rows = rows_of(recording, stretch);
    if (plan.steady || !read_inputs(plan, recording, inputs, said_before)) return std::nullopt;
    std::set<std::string> differentiated;
    for (const model::Equation& e : model.equations) for (const formula::Formula& side : {e.sides.left, e.sides.right}) add_differentiated(side, differentiated);
    const std::size_t window = std::max(fewest, static_cast<std::size_t>(plan.samples()));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (differentiated.count(plan.inputs[i].name) == 0) continue;   // what commands may stand still
        const auto [run, next] = longest(inputs[i], rows);
        if (run.size() < window || run.size() < longer * next || 2 * run.size() > rows.size()) continue;
        std::vector<std::string> moving;
        for (std::size_t j = 0; j < inputs.size(); ++j) {
            if (j != i && motion(inputs[j], run.begin, run.end) > as_elsewhere * motion(inputs[j], rows.begin, rows.end)) moving.push_back(plan.inputs[j].name);
        }
        if (moving.empty()) continue;
        return fmt::format("{} stands at {:.6g} from {:.6g} to {:.6g} s while {} {}: its sensor is stuck, or friction holds the machine; estimates of windows in there say nothing of it", plan.inputs[i].name, inputs[i][run.begin],
                           recording.t[run.begin], recording.t[run.end - 1], fmt::join(moving, ", "), moving.size() == 1 ? "moves" : "move");
    }
    return std::nullopt;
}

}  // namespace algest::lab
