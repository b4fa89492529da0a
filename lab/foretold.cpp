// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/foretold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace algest::lab {

namespace {

constexpr double half = 0.5;            ///< of a squared error: less is no explanation
constexpr double told_apart = 1.1;      ///< ratio of squared training errors from which on a set is no rival, as of validation errors (1.05 squared)
constexpr double surely = 1.75;         ///< standard errors over 16 blocks: t of 15 degrees, 1 in 20, for one set is asked once
constexpr std::size_t refined_sets = 4; ///< chosen: each costs a fit to all training rows

/// Of a set's squared training error: what it would be if each effect had just halved it.
double priced(const Variant& v, double squared_error) { return squared_error / std::pow(half, static_cast<double>(v.amendments.size())); }

struct Ranked {
    double price;
    Tried tried;
};

void sort_by_price(std::vector<Ranked>& sets) {
    std::stable_sort(sets.begin(), sets.end(), [](const Ranked& a, const Ranked& b) { return a.price < b.price; });
}

/// The few sets that explain the training rows best as they are fitted now, then fitted to all of them, best first.
std::vector<Ranked> best_few(Workbench& bench, const std::vector<Tried>& tried) {
    std::vector<Ranked> all;
    for (const Tried& t : tried) {
        const double error = output_error(t.variant.model, t.variant.bench, bench.start_of(t.variant, t.variant, &Parts::train));
        if (std::isfinite(error)) all.push_back({priced(t.variant, error), t});
    }
    sort_by_price(all);
    std::vector<Ranked> out;
    for (Ranked& r : all) {
        const bool known = std::any_of(out.begin(), out.end(), [&](const Ranked& o) { return identities(o.tried.variant) == identities(r.tried.variant); });
        if (known || out.size() == refined_sets) continue;
        bench.refine(r.tried.variant);
        r.price = priced(r.tried.variant, r.tried.variant.fit.cost);
        out.push_back(std::move(r));
    }
    sort_by_price(out);
    return out;
}

}  // namespace

bool choose_what_foretells(Workbench& bench, const Variant& nominal, Selection& selection) {
    if (bench.drifts(nominal)) return false;
    bench.begin_check();
    const std::vector<Ranked> few = best_few(bench, selection.tried);
    Variant before = nominal;
    bench.refine(before);
    if (few.empty() || !(few[0].price < before.fit.cost)) return false;
    const Variant& best = few[0].tried.variant;
    const Score without = bench.free_run_score(before, &Parts::test);
    const Score with = bench.free_run_score(best, &Parts::test);
    const double left = with.nrmse / without.nrmse;
    if (!(left * left < half) || !(significance(with, without) > surely)) return false;
    for (std::size_t k = 1; k < few.size(); ++k) {
        const std::set<std::string> own = identities(best), other = identities(few[k].tried.variant);
        const bool holds_it = std::includes(other.begin(), other.end(), own.begin(), own.end());
        if (holds_it || !(few[k].tried.variant.fit.cost < told_apart * best.fit.cost)) continue;
        for (const std::size_t row : few[k].tried.evidence) selection.evidence[row].rival = true;
        selection.rivals.push_back(few[k].tried.variant);
    }
    for (const std::size_t row : few[0].tried.evidence) selection.evidence[row].chosen = true;
    selection.as_well.push_back(fmt::format("what was added was chosen by the whole training stretch, for its last part alone does not show it; the test stretch was asked once, and has {:.3g} percent of its error left", 100 * left));
    selection.best = best;
    return true;
}

}  // namespace algest::lab
