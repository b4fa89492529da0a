// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/decide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/foretold.hpp"
#include "lab/judge.hpp"
#include "lab/noise.hpp"
#include "lab/remainder.hpp"

namespace algest::lab {

namespace {

constexpr double rows_that_see = 2.0;   ///< residual of the nominal model over noise, from which on rows may overrule a long run
constexpr double told_from_zero = 3.0;    ///< standard deviations of a strength, below which it may be none: chance reaches them once in 370. The least of 280 right names is 28
constexpr double nothing_is_left = 1.01;   ///< gap below which no law can hold 3 percent of the squared error

/// Fits the nominal model and looks for what it lacks, by the yardstick of the bench.
Selection search(Workbench& bench, Variant& nominal, const std::vector<double>& declared, const std::vector<Effect>& effects, const StepReport& progress) {
    if (progress) progress("fit the nominal model", 0.02);
    bench.begin_search();
    bench.fit_and_score(nominal, declared, nominal.bench.initial);
    if (nominal.score.gap() <= at_the_floor) return {nominal, {}, {}, false};
    return select_effects(bench, nominal, effects, progress);
}

/// What a name leaves, or the model as it is, that no noise makes; known floors alone tell.
std::optional<Remainder> left_beside(Workbench& bench, const Variant& nominal, const Variant& best) {
    if (bench.yardstick() != Yardstick::free_run || guesses_noise(nominal.model, nominal.bench) || best.score.gap() <= nothing_is_left) return std::nullopt;
    bench.begin_check();
    return remainder(bench, best);
}

/// One law that does what several named effects do, or what one leaves undone; known floors alone tell.
std::optional<Remainder> law_instead(Workbench& bench, const Variant& nominal, const Variant& best) {
    const bool alone = best.amendments.size() == 1;
    const bool enough = alone && (best.score.gap() <= at_the_floor || bench.yardstick() != Yardstick::free_run);   // by rows there is no floor to be above
    if (enough || guesses_noise(nominal.model, nominal.bench)) return std::nullopt;
    bench.begin_search();
    return plainer_law(bench, nominal, best);
}

/// The sentence about a law that does the work of what was named.
std::string instead(const Remainder& law, const Variant& best) {
    const std::string of = fmt::format("one law, {} in '{}', explains ", law.term, law.equation);
    return best.amendments.size() > 1 ? of + fmt::format("as much as {} effects together: they imitate it", best.amendments.size()) : of + "more than " + best.amendments[0].effect + ", which imitates it";
}

/// Searches by rows where the free run names nothing and drifts; the rows' answer counts where they see more than noise.
void ask_rows(Workbench& bench, Variant& nominal, const std::vector<double>& declared, const std::vector<Effect>& effects, const StepReport& progress, Decision& out) {
    Variant by_rows = nominal;
    bench.measure_by(Yardstick::rows);
    Selection second = search(bench, by_rows, declared, effects, progress);
    const Verdict verdict = judge(bench, by_rows, second);
    // Rows at the level of the noise, before as after, see nothing: then the long run, which adds it up, knows better.
    if (!names_something(verdict) || by_rows.score.gap() <= rows_that_see) {
        bench.measure_by(Yardstick::free_run);
        return;
    }
    out.selection = std::move(second);
    out.verdict = verdict;
    nominal = std::move(by_rows);
}

/// Takes a name back where its strength may be zero; a name, or `none`, where a plain law is left, or does it alone.
void take_back(Workbench& bench, const Variant& nominal, Decision& out) {
    const Variant& best = out.selection.best;
    if (names_something(out.verdict)) {
        if (const Amendment* a = may_be_nothing(best)) {
            const NewName& strength = a->names[0];
            const std::size_t p = static_cast<std::size_t>(best.model.parameter_index(strength.name));
            out.against.push_back(fmt::format("{} makes the error smaller, but {} = {:.3g} {} is known to {:.2g} only: it may be nothing", a->effect, strength.name, best.fit.parameters[p], strength.unit, best.fit.sd[p]));
        } else if (const auto law = law_instead(bench, nominal, best)) {
            out.against.push_back(instead(*law, best));
        } else if (const auto rest = left_beside(bench, nominal, best)) {
            out.against.push_back(fmt::format("{} takes most of the gap, but what is left in '{}' still follows {}: the law that is missing is another one", best.amendments.back().effect, rest->equation, rest->term));
        }
    } else if (out.verdict == Verdict::none) {
        if (const auto rest = left_beside(bench, nominal, nominal)) out.against.push_back(fmt::format("the model is near the noise, but what is left in '{}' still follows {}", rest->equation, rest->term));
    }
    if (!out.against.empty()) out.verdict = Verdict::unknown;
}

}  // namespace

bool names_something(Verdict verdict) { return verdict == Verdict::named || verdict == Verdict::ambiguous; }

const Amendment* may_be_nothing(const Variant& best) {
    const auto told = [&](const NewName& n) {
        const int p = best.model.parameter_index(n.name);
        const double sd = p < 0 ? 0 : best.fit.sd[static_cast<std::size_t>(p)];
        return p < 0 || n.scanned || !std::isfinite(sd) || std::abs(best.fit.parameters[static_cast<std::size_t>(p)]) > told_from_zero * sd;   // not seen: scaled with others, not small
    };
    for (const Amendment& a : best.amendments) {
        if (!a.names.empty() && a.substitutions.empty() && a.states.empty() && a.freed.empty() && std::none_of(a.names.begin(), a.names.end(), told)) return &a;
    }
    return nullptr;
}

Decision decide(Workbench& bench, Variant& nominal, const std::vector<double>& declared, const std::vector<Effect>& effects, const StepReport& progress) {
    Decision out{search(bench, nominal, declared, effects, progress), Verdict::unknown, {}};
    out.verdict = judge(bench, nominal, out.selection);
    if (!names_something(out.verdict) && out.selection.best.score.gap() > far_from_the_floor && bench.drifts(out.selection.best)) ask_rows(bench, nominal, declared, effects, progress, out);
    if (!names_something(out.verdict) && guesses_noise(nominal.model, nominal.bench)) {
        out.verdict = judge(bench, nominal, out.selection, Floor::a_guess);
        if (!names_something(out.verdict) && out.selection.best.amendments.empty() && choose_what_foretells(bench, nominal, out.selection)) {
            out.verdict = out.selection.rivals.empty() ? Verdict::named : Verdict::ambiguous;
        }
    }
    take_back(bench, nominal, out);
    return out;
}

}  // namespace algest::lab
