// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/further_order.hpp"

#include <algorithm>
#include <cmath>

#include "lab/median.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr int neighbours = 10;            ///< steps of the scan on each side that make the floor,
constexpr int too_near = 1;               ///< but these: they share the line where the recording has less than a turn
constexpr double by_chance = 0.01;        ///< that noise alone makes such a line somewhere in the scan

/// An effect that stands for each step of its scan: an order is a whole number.
bool goes_in_steps(const Effect& effect) {
    return effect.rewrite == Rewrite::add_term && effect.scans.size() == 1 && effect.scans[0].step > 0 && !effect.scans[0].fitted && !effect.scans[0].spectrum && effect.scans[0].of.empty();
}

std::size_t index_of(const model::Model& model, const std::string& equation) {
    const auto found = std::find_if(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return e.name == equation; });
    return static_cast<std::size_t>(found - model.equations.begin());
}

/// Whether v has the effect with this value of its scan.
bool stands(const Variant& v, const Effect& effect, double value) {
    return std::any_of(v.amendments.begin(), v.amendments.end(), [&](const Amendment& a) {
        return a.effect == effect.name && std::any_of(a.names.begin(), a.names.end(), [&](const NewName& n) { return n.scanned && std::abs(n.value - value) < 0.5 * effect.scans[0].step; });
    });
}

/// How often noise makes the ratio of one line's power (two degrees of freedom) to the mean of `count` others as large.
double chance_of(double ratio, int count) { return std::pow(1 + ratio / count, -count); }

struct Line {
    double value;
    double power = 0;                 ///< that it takes from the rows' squared residual
    std::vector<double> start = {};
};

/// What each further value of the scan takes from the rows, windows of one length; empty where there are no rows.
std::vector<Line> lines_of(const Workbench& bench, const Variant& v, const Binding& binding, int intervals) {
    const std::string& where = v.whole.equations[binding.equations[0]].name;
    const auto stretches = bench.stretches(v, &Parts::train);
    const auto form = weak_form(v.model, stretches, index_of(v.model, where), intervals);
    if (!form) return {};
    const double before = weak_fit(*form, v.fit.parameters).residual;
    std::vector<Line> out;
    const EffectScan& scan = binding.effect->scans[0];
    for (double value = scan.from; value <= scan.to + 1e-9; value += scan.step) {
        out.push_back({value});
        if (stands(v, *binding.effect, value)) continue;
        const Amendment a = amendment(binding, v.model, value);
        const auto model = bench.runnable(amended(v.text, v.whole, a));
        const auto with = model ? weak_form(*model, stretches, index_of(*model, where), intervals) : std::nullopt;
        if (!with) continue;
        std::vector<double> start;
        for (const model::Parameter& p : model->parameters) {
            const int old = v.model.parameter_index(p.name);
            start.push_back(old >= 0 ? v.fit.parameters[static_cast<std::size_t>(old)] : 0.0);
        }
        const WeakFit fit = weak_fit(*with, start);
        out.back().power = before - fit.residual;
        out.back().start = fit.parameters;
    }
    return out;
}

/// The ratio of a line's power to that of its neighbours, and how many these are. Their median stands for all of them, since other orders that
/// are there are no noise; of noise it is log(2) of the mean.
std::pair<double, int> above_neighbours(const std::vector<Line>& lines, std::size_t k) {
    std::vector<double> floor;
    for (int d = -neighbours; d <= neighbours; ++d) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(k) + d;
        if (std::abs(d) <= too_near || at < 0 || at >= static_cast<std::ptrdiff_t>(lines.size()) || lines[static_cast<std::size_t>(at)].start.empty()) continue;
        floor.push_back(std::max(lines[static_cast<std::size_t>(at)].power, 0.0));
    }
    const int count = static_cast<int>(floor.size());
    const double noise = median(std::move(floor)).value_or(0) / std::log(2.0);
    return {noise > 0 ? lines[k].power / noise : 0, count};
}

}  // namespace

std::optional<Candidate> further_order(const Workbench& bench, const Variant& v, const Amendment& held, const Effect& effect) {
    if (!goes_in_steps(effect)) return std::nullopt;
    std::vector<bool> measured;
    for (const std::vector<double>& m : v.bench.measured) measured.push_back(!m.empty());
    const std::vector<Binding> all = bindings(effect, v.whole, measured);
    const auto binding = std::find_if(all.begin(), all.end(), [&](const Binding& b) { return identity(amendment(b, v.model, 0)) == identity(held); });
    if (binding == all.end()) return std::nullopt;
    std::optional<Candidate> best;
    const std::vector<int> lengths = weak_intervals(bench.parts().train);
    for (const int intervals : lengths) {
        const std::vector<Line> lines = lines_of(bench, v, *binding, intervals);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            if (lines[k].start.empty()) continue;
            const auto [ratio, count] = above_neighbours(lines, k);
            if (count == 0 || chance_of(ratio, count) * static_cast<double>(lines.size() * lengths.size()) > by_chance) continue;
            if (!best || ratio > best->strength) best = Candidate{*binding, lines[k].value, ratio, 0, {}, lines[k].start};
        }
    }
    return best;
}

}  // namespace algest::lab
