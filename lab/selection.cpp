// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/selection.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "lab/further_order.hpp"
#include "lab/golden_section.hpp"
#include "lab/noise.hpp"
#include "lab/precedence.hpp"
#include "lab/spectrum.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr int most_effects = 3;
constexpr std::size_t by_rows = 4;              ///< candidates of the weak form that are fitted in free run, beside each base
constexpr std::size_t by_run = 4;               ///< more, of the free run's slope
constexpr double least_strength = 4;            ///< F statistic below which a candidate is not worth a fit, beyond the first
constexpr double least_share = 0.02;             ///< of the free run's error, the same
constexpr double a_base_within = 2.0;           ///< validation error of a further base, over that of the best
constexpr std::size_t bases = 2;                ///< that a further effect is tried beside: the best set of one may not be part of the best of two
constexpr double on_the_floor = 1.03;           ///< gap that leaves nothing to a second effect
constexpr double still_falling = 0.7;           ///< validation error over the base's, below which a fit that has not ended goes on
constexpr double needed_gain = 0.95;            ///< an effect must bring the validation error below this times what it was
constexpr double needed_gain_of_further = 0.8;  ///< the same of a further effect where noise is guessed: nothing says what noise would leave
constexpr double needed_significance = 2.5;     ///< standard errors of the difference over blocks (16: a t of 2.5 is 1 in 40)
constexpr double rows_of_no_chance = 50;        ///< F statistic that noise of the process does not reach
constexpr double rows_of_chance = 8;            ///< strength that noise hardly reaches. Of a scan it is an F of 12: two parameters, 119 orders and 10 places
                                                ///< reach that in 1190 exp(-12), one search of 140; of one parameter without a scan in 5 of 1000 places
constexpr double gain_against_rows = 40;        ///< that it takes where rows see an effect, and find it no more than chance: four times the bar, chosen
constexpr double gain_by_chance = 10;           ///< that the best of 50 candidates has, one search in three: 2 ln(50 * 3)
constexpr int most_orders = 4;                  ///< of one effect, beside the first: chosen, for each costs a fit
constexpr double alike = 1.05;                  ///< validation errors within this ratio are not told apart,
constexpr double surely_worse = 2.0;            ///< nor those whose difference is not this significant...
constexpr double clearly_worse = 1.3;           ///< ... unless they are beyond this ratio

/// Deflated information criterion of v over the nominal model: larger is better.
double criterion(const Variant& v, const Variant& nominal) {
    double rows = 0;   // the nominal model's, the same for all: a good fit leaves white noise, whose rows all count
    for (const double n : nominal.score.independent) rows += n;
    return log_gain(v.score, nominal.score) - added_parameters(v) * std::log(std::max(rows, 2.0));
}

/// Parameters of v's model as another variant's fit has them; initial values for those that it lacks.
std::vector<double> carried_over(const Variant& v, const Variant& from) {
    std::vector<double> out;
    for (const model::Parameter& p : v.model.parameters) {
        const int old = from.model.parameter_index(p.name);
        out.push_back(old >= 0 ? from.fit.parameters[static_cast<std::size_t>(old)] : exact::nearest(*p.initial, plan::Scalar::float64));
    }
    return out;
}

Evidence evidence_of(const Variant& v, const Variant& base, double strength, int step) {
    const Amendment& a = v.amendments.back();
    return {a.effect, place(a, v.whole), change(a), strength, v.score.nrmse, log_gain(v.score, base.score), false, false, step};
}

bool indistinguishable(const Variant& best, const Variant& other) {
    const double ratio = other.score.nrmse / best.score.nrmse;
    return ratio < alike || (ratio < clearly_worse && significance(best.score, other.score) < surely_worse);
}

/// With every scanned frequency placed anew beside the other effects: it was found before they were there.
Variant sharpened(Workbench& bench, Variant best, const Variant& nominal, const std::vector<Effect>& effects) {
    const Rows rows = bench.parts().fitted;
    for (std::size_t k = 0; k < best.amendments.size(); ++k) {
        const auto effect = std::find_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.name == best.amendments[k].effect; });
        if (effect->scans.empty() || !effect->scans[0].spectrum || best.amendments.size() < 2) continue;
        std::vector<Amendment> moved = best.amendments;
        const auto frequency = std::find_if(moved[k].names.begin(), moved[k].names.end(), [](const NewName& n) { return n.constant; });
        const auto residual = [&](double value) {
            frequency->value = value;
            const auto model = bench.runnable(amended_in_turn(nominal.text, bench.path(), moved));
            double sum = 0;
            for (std::size_t e = 0; model && e < model->equations.size(); ++e) {
                for (const int intervals : weak_intervals(rows)) {
                    const auto form = weak_form(*model, best.bench, e, rows, intervals);
                    if (form) sum += std::log(std::max(weak_fit(*form, best.fit.parameters).residual, 1e-300));
                }
            }
            return sum;
        };
        const double width = line_width(rows.size(), best.bench.drive.period);
        const double there = least_by_golden_section(residual, frequency->value - 0.5 * width, frequency->value + 0.5 * width);
        frequency->value = there;
        Diagnostics quiet;
        auto v = bench.prepare(amended_in_turn(nominal.text, bench.path(), moved), moved, quiet);
        if (!v) continue;
        bench.fit_and_score(*v, carried_over(*v, best), carried_initial(*v, best));
        if (v->score.nrmse < best.score.nrmse) best = std::move(*v);
    }
    return best;
}

/// With thin layers, as long as those explain more: how sharply the machine switches is not in any model.
Variant sharply_switched(const Workbench& bench, Variant best) {
    if (best.bench.system.layers.empty() || bench.yardstick() != Yardstick::free_run || best.score.gap() <= at_the_floor) return best;
    for (const double width : thin_layers) {
        Variant v = best;
        v.bench.options.layer_width = width;
        for (Bench& further : v.further) further.options.layer_width = width;
        bench.fit_and_score(v, best.fit.parameters, best.fit.initial);
        if (!(v.score.nrmse < best.score.nrmse)) return best;
        best = std::move(v);
        if (best.score.gap() <= at_the_floor) return best;
    }
    return best;
}

/// Without every effect whose absence is not noticed.
Variant pruned(Workbench& bench, Variant best, const Variant& nominal, const std::function<bool(const Score&, const Score&)>& is_missed) {
    for (bool changed = true; changed && best.amendments.size() > 1;) {
        changed = false;
        for (std::size_t without = 0; without < best.amendments.size() && !changed; ++without) {
            std::vector<Amendment> kept = best.amendments;
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(without));
            const std::string text = amended_in_turn(nominal.text, bench.path(), kept);
            if (text.empty()) continue;   // another one stands in what it brings
            Diagnostics quiet;
            auto v = bench.prepare(text, kept, quiet);
            if (!v) continue;
            bench.fit_and_score(*v, carried_over(*v, best), carried_initial(*v, best));
            if (is_missed(best.score, v->score)) continue;
            best = std::move(*v);
            changed = true;
        }
    }
    return best;
}

/// Which of the others the data do not tell from `named`, into the selection; the rows of the rivals' evidence.
std::vector<std::size_t> tell_rivals(Selection& out, const Precedence& precedence, const Contender& named, const std::vector<Tried>& others) {
    std::vector<std::size_t> rows;
    out.rivals.clear();
    out.as_well.clear();
    const std::set<std::string> own = identities(*named.variant);
    for (const Tried& other : others) {
        if (identities(other.variant) == own || !indistinguishable(*named.variant, other.variant) || precedence.fitted_rows_tell(*named.variant, other.variant)) continue;
        const Precedence::Standing standing = precedence.beside(named, {&other.variant, out.evidence[other.evidence.back()].strength});
        if (standing == Precedence::Standing::as_well) out.as_well.push_back(precedence.doubt(*named.variant, other.variant));
        if (standing != Precedence::Standing::rival) continue;
        out.rivals.push_back(other.variant);
        rows.push_back(other.evidence.back());
    }
    return rows;
}

/// Further orders of what was chosen, the strongest first: each has to stand out in the rows and to make the validation error smaller.
void add_further_orders(Workbench& bench, Selection& out, const std::vector<Effect>& effects) {
    const std::vector<Amendment> chosen = out.best.amendments;
    for (const Amendment& a : chosen) {
        const auto effect = std::find_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.name == a.effect; });
        for (int k = 0; k < most_orders && !bench.used_up(); ++k) {
            const auto candidate = further_order(bench, out.best, a, *effect);
            if (!candidate) break;
            auto v = with_candidate(bench, out.best, *candidate);
            if (!v || !(v->score.nrmse < out.best.score.nrmse)) break;
            out.evidence.push_back(evidence_of(*v, out.best, candidate->strength, static_cast<int>(v->amendments.size())));
            out.evidence.back().chosen = true;
            out.best = std::move(*v);
        }
    }
}

/// Sets with as many effects as this one at the most.
std::vector<Tried> no_larger(const std::vector<Tried>& all, const Variant& than) {
    std::vector<Tried> out;
    std::copy_if(all.begin(), all.end(), std::back_inserter(out), [&](const Tried& t) { return t.variant.amendments.size() <= than.amendments.size(); });
    return out;
}

}  // namespace

std::optional<Variant> with_candidate(Workbench& bench, const Variant& base, const Candidate& c) {
    const Workbench::OneOfMany share(bench);
    Amendment a = amendment(c.binding, base.model, c.scan);
    const auto probe = bench.runnable(amended(base.text, base.whole, a));
    if (!probe) return std::nullopt;
    for (NewName& n : a.names) {   // the weak form's value is where the fit starts
        if (n.constant) continue;
        const int p = probe->parameter_index(n.name);
        if (p >= 0) n.value = c.start[static_cast<std::size_t>(p)];
        if (n.min) n.value = std::max(n.value, *n.min);
    }
    auto amendments = base.amendments;
    amendments.push_back(a);
    Diagnostics quiet;
    auto v = bench.prepare(amended(base.text, base.whole, a), std::move(amendments), quiet);
    if (!v) return std::nullopt;
    bench.fit_and_score(*v, carried_over(*v, base), carried_initial(*v, base));
    // What bends a model is further from its start than a term is.
    if (!v->fit.converged && v->score.nrmse < still_falling * base.score.nrmse) bench.fit_and_score(*v, std::vector<double>(v->fit.parameters), std::vector<double>(v->fit.initial));
    // Rows that see so much of it do not err: the run has gone astray.
    const bool stuck = !v->fit.converged && v->score.gap() > at_the_floor && !guesses_noise(v->model, v->bench);
    if (c.strength > rows_of_no_chance && (stuck || !(v->score.nrmse < base.score.nrmse))) bench.fit_growing(*v);
    return v;
}

std::set<std::string> identities(const Variant& v) {
    std::set<std::string> out;
    for (const Amendment& a : v.amendments) out.insert(identity(a));
    return out;
}

bool worth_it(const Score& a, const Score& b, double gain) {
    double ratio = 0;   // geometric mean over outputs: each counts alike, whatever its floor
    for (std::size_t o = 0; o < a.error.size(); ++o) ratio += std::log(std::max(a.error[o], 1e-300) / std::max(b.error[o], 1e-300)) / static_cast<double>(a.error.size());
    return std::exp(ratio) < gain && significance(a, b) > needed_significance;
}

Selection select_effects(Workbench& bench, const Variant& nominal, const std::vector<Effect>& effects, const StepReport& progress) {
    Selection out{nominal, {}, {}, false};
    const Precedence precedence(effects);
    std::vector<Tried> beside = {{nominal, {}}};
    std::vector<Tried> all;
    std::vector<std::size_t> chosen, rivals;   // rows of the evidence
    const bool guessed = bench.yardstick() == Yardstick::free_run && guesses_noise(nominal.model, nominal.bench);
    // What goes down to a declared noise explains everything, though it acts in few blocks only.
    const auto takes_all = [&](const Score& a, const Score& b) { return bench.yardstick() == Yardstick::free_run && !guessed && b.gap() > far_from_the_floor && a.gap() <= at_the_floor; };
    const auto is_worth = [&](const Score& a, const Score& b, double gain) { return takes_all(a, b) || worth_it(a, b, gain); };
    const auto gain_of = [&](std::size_t effects_in_all) { return guessed && effects_in_all > 1 ? needed_gain_of_further : needed_gain; };
    bool ahead = false;   // the last step's effects are not worth it alone, a further one may show that they are
    std::set<std::set<std::string>> tried;
    for (int step = 1; step <= most_effects; ++step) {
        std::vector<Tried> fitted;
        for (std::size_t b = 0; b < beside.size() && !bench.used_up(); ++b) {
            const Variant& base = beside[b].variant;
            const double share = (step - 1 + static_cast<double>(b) / static_cast<double>(beside.size())) / most_effects;
            if (progress) progress("screen effects", 0.1 + 0.8 * share);
            std::size_t seen = 0;
            for (const Candidate& c : screen(bench, base, effects, by_rows, by_run)) {
                if (++seen > 1 && c.strength < least_strength && !(c.share > least_share)) continue;
                std::set<std::string> id = identities(base);
                id.insert(identity(amendment(c.binding, base.model, c.scan)));
                if (c.binding.effect->scans.empty() && !tried.insert(id).second) continue;
                if (bench.used_up()) break;
                if (progress) progress("fit " + c.binding.effect->name, 0.1 + 0.8 * share + 0.2 / most_effects);
                auto v = with_candidate(bench, base, c);
                if (!v) continue;
                std::vector<std::size_t> evidence = beside[b].evidence;
                evidence.push_back(out.evidence.size());
                out.evidence.push_back(evidence_of(*v, base, c.strength, step));
                fitted.push_back({std::move(*v), std::move(evidence)});
            }
        }
        if (fitted.empty()) break;
        std::vector<std::size_t> order(fitted.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        const double gain = gain_of(out.best.amendments.size() + 1);
        std::vector<std::pair<bool, double>> merit;   // what is worth adding comes first: the criterion counts the rows of a poor fit as few
        for (const Tried& t : fitted) merit.emplace_back(is_worth(t.variant.score, out.best.score, gain), criterion(t.variant, nominal));
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return merit[a] > merit[b]; });
        // A wave of time fits what hangs on an angle at constant speed, a hysteresis what dry friction does, and so does dry friction that falls.
        const auto contender = [&](std::size_t k) { return Contender{&fitted[k].variant, out.evidence[fitted[k].evidence.back()].strength}; };
        const Variant& nearest = fitted[order[0]].variant;
        for (std::size_t k = 1; k < order.size(); ++k) {
            const Variant& other = fitted[order[k]].variant;
            if (precedence.before(contender(order[k]), contender(order[0])) && indistinguishable(nearest, other) && !precedence.fitted_rows_tell(nearest, other)) std::swap(order[0], order[k]);
        }
        for (std::size_t k = 1; k < order.size(); ++k) {
            const Variant& other = fitted[order[k]].variant;
            if (indistinguishable(nearest, other) && precedence.fitted_rows_tell(other, fitted[order[0]].variant)) std::swap(order[0], order[k]);
        }
        std::vector<Tried> ordered;
        for (const std::size_t k : order) ordered.push_back(std::move(fitted[k]));
        const Contender named = {&ordered[0].variant, out.evidence[ordered[0].evidence.back()].strength};
        const Variant& top = *named.variant;
        std::vector<Tried> next;
        for (const Tried& t : ordered) if (next.size() < bases && t.variant.score.nrmse < a_base_within * top.score.nrmse) next.push_back(t);
        all.insert(all.end(), ordered.begin(), ordered.end());
        // Two that mend nothing alone are named together only where they explain everything; and so are two beside a declared noise, for two
        // laws bend into the shape of a third.
        const bool to_the_floor = ahead || (!out.best.amendments.empty() && bench.yardstick() == Yardstick::free_run && !guessed);
        // A run that drifts on noise of the process is one sample, however long: some effect lies on its way.
        const double needed = named.strength > 0 && named.strength < rows_of_chance ? gain_against_rows : gain_by_chance;
        // None lies on all of it: noise of the process stays when an effect has taken its part.
        const bool leaves_noise = takes_all(top.score, out.best.score) && top.score.white();
        const bool by_chance = bench.yardstick() == Yardstick::free_run && !guessed && !leaves_noise && named.strength < rows_of_no_chance && log_gain(top.score, out.best.score) < needed;
        if (by_chance || !is_worth(top.score, out.best.score, gain) || (to_the_floor && top.score.gap() > far_from_the_floor)) {
            if (ahead) break;
            ahead = true;
            beside = std::move(next);
            continue;
        }
        ahead = false;
        chosen = ordered[0].evidence;
        rivals = tell_rivals(out, precedence, named, ordered);
        out.best = sharply_switched(bench, sharpened(bench, top, nominal, effects));
        beside = std::move(next);
        beside[0].variant = out.best;
        // One effect with much to fit may come near to the floor where two plain ones reach it.
        const double enough = out.best.amendments.back().names.size() > 1 ? on_the_floor : at_the_floor;
        if (out.best.score.gap() <= enough || bench.used_up()) break;
    }
    const std::size_t before = out.best.amendments.size();
    out.best = pruned(bench, out.best, nominal, [&](const Score& with, const Score& without) { return is_worth(with, without, gain_of(2)); });
    const auto kept = [&](std::size_t r) {
        return std::any_of(out.best.amendments.begin(), out.best.amendments.end(), [&](const Amendment& a) { return a.effect == out.evidence[r].effect && place(a, out.best.whole) == out.evidence[r].equation; });
    };
    chosen.erase(std::remove_if(chosen.begin(), chosen.end(), [&](std::size_t r) { return !kept(r); }), chosen.end());
    // What is left without the effects that are not missed was compared with others of its size while they were beside it.
    if (out.best.amendments.size() < before) rivals = tell_rivals(out, precedence, {&out.best, out.evidence[chosen.back()].strength}, no_larger(all, out.best));
    if (out.best.score.gap() > at_the_floor) add_further_orders(bench, out, effects);
    out.cut_short = bench.cut_short();
    for (const std::size_t r : chosen) out.evidence[r].chosen = true;
    for (const std::size_t r : rivals) out.evidence[r].rival = true;
    out.tried = std::move(all);
    return out;
}

}  // namespace algest::lab
