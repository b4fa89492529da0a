// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/operating_points.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace algest::lab {

namespace {

/// Means that differ by less than this part of the largest are the same: a sensor's noise moves the mean of a steady stretch by about as much, and
/// nobody who wants a second operating point sets a speed or a load that is so near to the first.
constexpr double same = 1e-3;

bool is_constant(const OperatingPoints& points, std::size_t quantity) {
    double low = points.at(0, quantity);
    double high = low;
    for (std::size_t k = 1; k < points.count(); ++k) {
        low = std::min(low, points.at(k, quantity));
        high = std::max(high, points.at(k, quantity));
    }
    return high - low <= same * std::max(std::abs(low), std::abs(high)) && (low != 0.0 || high != 0.0);
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
        if (is_constant(points, q)) needs += (needs.empty() ? "" : ", ") + plan.steady->averaged[q].name;
    }
    const std::string count = std::to_string(points.count()) + (points.count() == 1 ? " operating point" : " operating points");
    if (needs.empty()) return "not identifiable from these data: " + count + " do not tell the parameters apart";
    return "not identifiable from these data: needs a second value of " + needs + ", the same at all of " + count;
}

}  // namespace algest::lab
