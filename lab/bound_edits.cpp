// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/bound_edits.hpp"

#include <algorithm>

#include "generator/dimension.hpp"
#include "lab/placeholders.hpp"
#include "lab/roles.hpp"
#include "lab/rotating_frame.hpp"

namespace algest::lab {

namespace {

/// The equations that an edit reaches from equation e; empty: none.
std::vector<std::size_t> reached(Reach reach, std::size_t e, const model::Model& model, const std::vector<bool>& measured) {
    if (reach == Reach::own) return {e};
    if (reach == Reach::all) {
        std::vector<std::size_t> out;
        for (std::size_t k = 0; k < model.equations.size(); ++k) if (model.equations[k].sides.right != nullptr) out.push_back(k);
        return out;
    }
    if (reach == Reach::fed) {
        const int own = moved(model, model.equations[e]).signal;
        const units::Unit unit = model::unit_of_equation(model, model.equations[e]);
        std::vector<std::size_t> out;
        for (std::size_t k = 0; own >= 0 && k < model.equations.size(); ++k) {
            const units::Unit other = model::unit_of_equation(model, model.equations[k]);
            const bool balances_alike = !unit.known() || !other.known() || unit.same_dimension(other);
            if (k != e && balances_alike && moved(model, model.equations[k]).signal >= 0 && !places_of_name(model.equations[k], model.signals[static_cast<std::size_t>(own)].name).empty()) out.push_back(k);
        }
        return out;
    }
    const auto frame = rotating_frame(model, measured);
    if (!frame || frame->d_equation != e) return {};
    if (reach == Reach::d) return {frame->d_equation};
    if (reach == Reach::q) return {frame->q_equation};
    for (std::size_t k = 0; k < model.equations.size(); ++k) {
        const Moved own = moved(model, model.equations[k]);
        if (own.signal >= 0 && own.order == 1 && model.signals[static_cast<std::size_t>(own.signal)].name == frame->speed) return {k};
    }
    return {};
}

/// The binding's equations with those added that it is said to enter, in the order of the model, each with the terms that come into it.
class Touched {
public:
    void touch(std::size_t equation) { terms_.emplace(equation, ""); }
    void add(std::size_t equation, const std::string& term) { terms_[equation] += terms_[equation].empty() ? term : " " + term; }
    void into(Binding& b) const {
        b.equations.clear();
        b.terms.clear();
        for (const auto& [equation, term] : terms_) {
            b.equations.push_back(equation);
            b.terms.push_back(term);
        }
        const auto roles = b.roles[0];
        b.roles.assign(b.equations.size(), roles);
    }

private:
    std::map<std::size_t, std::string> terms_;
};

/// The signal v with an equation der(x) = v; empty: none.
std::string rate_of(const model::Model& model, const std::string& x) {
    const int position = model.signal_index(x);
    for (std::size_t s = 0; s < model.signals.size(); ++s) if (integral_of(model, static_cast<int>(s)) == position) return model.signals[s].name;
    return "";
}

bool has_role(const Effect& effect, const std::string& kind) {
    return std::any_of(effect.roles.begin(), effect.roles.end(), [&](const auto& role) { return role.second == kind || role.second == "unsigned_" + kind; });
}

/// A sensor's fault shows in every equation with its signal, and is said to be where that signal is moved.
void bind_freed(Binding& b, const model::Model& model) {
    b.freed = b.roles[0].at(b.effect->freed);
    Touched touched;
    for (const std::size_t k : reached(Reach::all, 0, model, {})) if (!places_of_name(model.equations[k], b.freed).empty()) touched.touch(k);
    touched.into(b);
}

}  // namespace

Places places_of(const Substitution& s, const model::Model& model) {
    const model::Equation& e = model.equations[s.equation];
    if (s.what[0] == '(') {
        const std::size_t minus = s.what.find('-');
        const std::string a = s.what.substr(1, minus - 1);
        const std::string b = s.what.substr(minus + 1, s.what.size() - minus - 2);
        Places out{places_of_difference(e, a, b), places_of_difference_of_rates(e, a, b)};
        const std::string rate_of_a = rate_of(model, a);
        const std::string rate_of_b = rate_of(model, b);
        if (rate_of_a.empty() || rate_of_b.empty()) return out;
        for (const Stretch& at : places_of_difference(e, rate_of_a, rate_of_b)) out.derivatives.push_back(at);
        return out;
    }
    Places out{places_of_name(e, s.what), {}};
    const bool is_signal = model.signal_index(s.what) >= 0;
    if (is_signal) out.derivatives = places_of_derivative(e, s.what);
    if (s.part == Part::everywhere) return out;
    const std::vector<Stretch> leading = place_of_leading(model, e);
    const auto leads = [&](const Stretch& at) { return !leading.empty() && leading[0].begin == at.begin; };
    out.plain.erase(std::remove_if(out.plain.begin(), out.plain.end(), [&](const Stretch& at) { return leads(at) != (s.part == Part::leading); }), out.plain.end());
    return out;
}

bool bind_edits(Binding& b, const model::Model& model, const std::vector<bool>& measured) {
    const Effect& effect = *b.effect;
    const std::size_t own = b.equations[0];
    if (effect.rewrite == Rewrite::free_constant) {
        bind_freed(b, model);
        return true;
    }
    Touched touched;
    for (const EffectEdit& edit : effect.edits) {
        bool found = edit.in == Reach::fed;   // what runs over may be lost
        for (const std::size_t k : reached(edit.in, own, model, measured)) {
            if (edit.in == Reach::fed) b.beside.insert(k);
            if (!edit.add.empty()) {
                touched.add(k, edit.add);
                found = true;
                continue;
            }
            Substitution s{k, b.roles[0].at(edit.what), edit.by, edit.derivative, edit.part, 0, b.roles[0]};
            const Places places = places_of(s, model);
            if (places.plain.empty() && places.derivatives.empty()) continue;
            found = true;
            if (!has_role(effect, "sensor")) touched.touch(k);
            b.substitutions.push_back(std::move(s));
        }
        if (!found) return false;
    }
    if (has_role(effect, "sensor")) touched.touch(own);
    touched.into(b);
    for (const EffectState& state : effect.states) {
        EffectState bound = state;
        bound.unit = filled_unit(state.unit, b.role_units);
        b.states.push_back({std::move(bound), 0, b.roles[0]});
    }
    return true;
}

bool is_bound_already(const Binding& b, const std::vector<Binding>& others) {
    const auto same = [&](const Binding& o) {
        const auto alike = [](const Substitution& x, const Substitution& y) { return x.equation == y.equation && x.what == y.what && x.by == y.by && x.roles == y.roles; };
        return o.freed == b.freed && o.equations == b.equations && o.terms == b.terms && o.roles[0] == b.roles[0] &&
               std::equal(o.substitutions.begin(), o.substitutions.end(), b.substitutions.begin(), b.substitutions.end(), alike);
    };
    return std::any_of(others.begin(), others.end(), same);
}

}  // namespace algest::lab
