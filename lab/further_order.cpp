// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/further_order.hpp"

#include <algorithm>
#include <cmath>

#include "lab/scan_values.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr int neighbours = 10;            ///< steps of the scan on each side that make the floor: enough for a median, near enough for one floor
constexpr int too_near = 1;               ///< but these: they share the line where the recording has less than a turn
constexpr int side_lobes = 3;             ///< steps from an order that is held: what its term leaves there is no noise
constexpr double by_chance = 0.01;        ///< that noise alone makes such a line somewhere in the scan
constexpr int waves = 2;                  ///< parameters of an order, a sine and a cosine: what noise takes from the rows by them is exponential

/// An effect that stands for each step of its scan with a sine and a cosine: an order is a whole number.
bool goes_in_steps(const Effect& effect) {
    return effect.rewrite == Rewrite::add_term && effect.parameters.size() == waves && effect.scans.size() == 1 && effect.scans[0].step > 0 && !effect.scans[0].fitted && !effect.scans[0].spectrum && effect.scans[0].of.empty();
}

/// Whether v has the effect with this value of its scan.
bool stands(const Variant& v, const Effect& effect, double value) {
    return std::any_of(v.amendments.begin(), v.amendments.end(), [&](const Amendment& a) {
        return a.effect == effect.name && std::any_of(a.names.begin(), a.names.end(), [&](const NewName& n) { return n.scanned && std::abs(n.value - value) < 0.5 * effect.scans[0].step; });
    });
}

struct Line {
    double value;
    bool held;                         ///< the variant has it
    double power = 0;                  ///< that it takes from the rows' squared residual
    double strength = 0;               ///< its F statistic
    std::vector<double> start = {};    ///< empty: it has no rows
};

/// What each further value of the scan takes from the rows, windows of one length; empty where there are no rows.
std::vector<Line> lines_of(const Workbench& bench, const Variant& v, const Binding& binding, int intervals) {
    const std::string& where = v.whole.equations[binding.equations[0]].name;
    const auto stretches = bench.stretches(v, &Parts::fitted);
    const auto form = weak_form(v.model, stretches, equation_index(v.model, where), intervals);
    if (!form) return {};
    const WeakFit before = weak_fit(*form, v.fit.parameters);
    std::vector<Line> out;
    for (const double value : scan_values(binding.effect->scans[0], 1)) {
        out.push_back({value, stands(v, *binding.effect, value)});
        if (out.back().held) continue;
        const Amendment a = amendment(binding, v.model, value);
        const auto model = bench.runnable(amended(v.text, v.whole, a));
        const auto with = model ? weak_form(*model, stretches, equation_index(*model, where), intervals) : std::nullopt;
        if (!with) continue;
        std::vector<double> start;
        for (const model::Parameter& p : model->parameters) {
            const int old = v.model.parameter_index(p.name);
            start.push_back(old >= 0 ? v.fit.parameters[static_cast<std::size_t>(old)] : 0.0);
        }
        const WeakFit after = weak_fit(*with, start);
        if (after.unknowns - before.unknowns != waves) continue;
        out.back().power = before.residual - after.residual;
        out.back().strength = f_statistic(before, after);
        out.back().start = after.parameters;
    }
    return out;
}

/// Whether an order that is held stands at most so many steps away.
bool beside_held(const std::vector<Line>& lines, std::size_t k, std::size_t steps) {
    for (std::size_t j = k - std::min(k, steps); j < std::min(k + steps + 1, lines.size()); ++j) if (lines[j].held) return true;
    return false;
}

/// How often noise alone makes line k as strong beside its neighbours: 1 where it has none. Of n exponential powers the m-th smallest is a sum of
/// exponential ones of means 1/n, 1/(n-1), ..., 1/(n-m+1) (Renyi), so that one more is r times as large with the chance
///   E exp(-r sum) = n/(n+r) (n-1)/(n-1+r) ... (n-m+1)/(n-m+1+r).
/// The median stands for all of them, of an even number the lower one, since other orders that are there are no noise.
double chance_of(const std::vector<Line>& lines, std::size_t k) {
    std::vector<double> floor;
    for (int d = -neighbours; d <= neighbours; ++d) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(k) + d;
        if (std::abs(d) <= too_near || at < 0 || at >= static_cast<std::ptrdiff_t>(lines.size())) continue;
        const Line& line = lines[static_cast<std::size_t>(at)];
        if (std::isfinite(line.power) && !line.start.empty() && !beside_held(lines, static_cast<std::size_t>(at), side_lobes)) floor.push_back(line.power);
    }
    const std::size_t n = floor.size();
    const std::size_t m = (n + 1) / 2;
    if (n == 0) return 1;
    std::nth_element(floor.begin(), floor.begin() + static_cast<std::ptrdiff_t>(m - 1), floor.end());
    const double ratio = lines[k].power / floor[m - 1];
    if (!(floor[m - 1] > 0) || !(ratio > 0)) return 1;
    double out = 1;
    for (std::size_t j = n - m + 1; j <= n; ++j) out *= static_cast<double>(j) / (static_cast<double>(j) + ratio);
    return out;
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
    double least = by_chance;
    const std::vector<int> lengths = weak_intervals(bench.parts().fitted);
    for (const int intervals : lengths) {
        const std::vector<Line> lines = lines_of(bench, v, *binding, intervals);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            if (!(lines[k].strength > 0) || beside_held(lines, k, too_near)) continue;
            // Beside neighbours that take next to nothing it may still be no more than any two parameters take from white rows: exp(-F) by chance.
            const double chance = std::max(chance_of(lines, k), std::exp(-lines[k].strength)) * static_cast<double>(lines.size() * lengths.size());
            if (!(chance < least)) continue;
            least = chance;
            best = Candidate{*binding, lines[k].value, lines[k].strength / price_of_a_scan, 0, {}, lines[k].start};
        }
    }
    return best;
}

}  // namespace algest::lab
