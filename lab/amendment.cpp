// SPDX-License-Identifier: GPL-3.0-or-later
// From a binding to an amendment: every name that it brings gets one that is free.
#include <algorithm>
#include <set>

#include "generator/names.hpp"
#include "generator/tidy_unit.hpp"
#include "generator/units.hpp"
#include "lab/amend.hpp"
#include "lab/placeholders.hpp"
#include "lab/roles.hpp"
#include "lab/whole_word.hpp"

namespace algest::lab {

namespace {

/// Replaces a name where it stands as a whole word.
void rename(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = find_whole_word(text, from); at != std::string::npos; at = find_whole_word(text, from, at + to.size())) text.replace(at, from.size(), to);
}

/// Names that are free, each given away once.
class FreshNames {
public:
    explicit FreshNames(const model::Model& model) {
        for (const auto& s : model.signals) taken_.insert(model::folded(s.name));
        for (const auto& c : model.constants) taken_.insert(model::folded(c.name));
        for (const auto& p : model.parameters) taken_.insert(model::folded(p.name));
    }

    std::string fresh(const std::string& wanted) {
        std::string name = wanted;
        for (int k = 2; !taken_.insert(model::folded(name)).second; ++k) name = wanted + std::to_string(k);
        return name;
    }

private:
    std::set<std::string> taken_;
};

/// The texts of a binding while its names are made free.
class Texts {
public:
    Texts(std::vector<std::string>& terms, std::vector<Substitution>& substitutions, std::vector<NewState>& states, std::vector<std::size_t> sets)
        : terms_(terms), substitutions_(substitutions), states_(states), sets_(std::move(sets)) {}

    bool have(const std::string& name) const {
        const auto has = [&](const std::string& text) { return find_whole_word(text, name) != std::string::npos; };
        return std::any_of(terms_.begin(), terms_.end(), has) || std::any_of(states_.begin(), states_.end(), [&](const NewState& s) { return has(s.ode); }) ||
               std::any_of(substitutions_.begin(), substitutions_.end(), [&](const Substitution& s) { return has(s.by) || has(s.derivative); });
    }

    void rename_everywhere(const std::string& from, const std::string& to) {
        for (std::string& t : terms_) rename(t, from, to);
        for (std::size_t k = 0; k <= largest_set(); ++k) rename_in_set(k, from, to);
    }

    void rename_in_set(std::size_t set, const std::string& from, const std::string& to) {
        for (Substitution& s : substitutions_) {
            if (s.state_set != set) continue;
            rename(s.by, from, to);
            rename(s.derivative, from, to);
        }
        for (std::size_t k = 0; k < states_.size(); ++k) if (sets_[k] == set) rename(states_[k].ode, from, to);
    }

private:
    std::size_t largest_set() const {
        std::size_t out = 0;
        for (const Substitution& s : substitutions_) out = std::max(out, s.state_set);
        return out;
    }

    std::vector<std::string>& terms_;
    std::vector<Substitution>& substitutions_;
    std::vector<NewState>& states_;
    std::vector<std::size_t> sets_;
};

std::string in_words(std::string effect) {
    std::replace(effect.begin(), effect.end(), '_', ' ');
    return effect;
}

NewName let_go(const std::string& constant, const model::Model& model) {
    const model::Constant& c = *model.constant(constant);
    const double value = exact::nearest(c.value, plan::Scalar::float64);
    NewName out{c.name, c.unit, value, std::nullopt, false};
    out.neutral = c.name;
    out.let_go = true;
    return out;
}

/// What is added to a temperature in degC is a difference, which has no unit that UDUNITS tells from a temperature in K: it goes unchecked.
std::string unit_of_difference(const std::string& unit) {
    const auto parsed = units::Unit::parse(unit);
    return parsed && parsed->known() && !parsed->same_origin(parsed->times(units::Unit::dimensionless())) ? "" : unit;
}

void join(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }

}  // namespace

Amendment amendment(const Binding& binding, const model::Model& model, double scan) {
    const Effect& effect = *binding.effect;
    Amendment out{effect.name, binding.equations, binding.terms, {}, "", "", effect.summary, binding.substitutions, {}, binding.freed};
    if (binding.roles[0].size() == 1 && model.signal_index(binding.roles[0].begin()->second) >= 0) out.against = binding.roles[0].begin()->second;
    for (const auto& [role, kind] : effect.roles) if (kind == "time" && model.signal_index(time_name(model)) < 0) out.time = time_name(model);
    std::vector<std::size_t> sets;
    for (const BoundState& s : binding.states) {
        out.states.push_back({s.state.name, s.state.unit, s.state.initial, "", s.state.ode});
        sets.push_back(s.state_set);
    }
    FreshNames names(model);
    Texts texts(out.terms, out.substitutions, out.states, sets);
    for (std::size_t k = 0; k < out.states.size(); ++k) {
        NewState& state = out.states[k];
        const std::string name = names.fresh(state.name);
        texts.rename_in_set(sets[k], state.name, name);
        if (sets[k] == 0) for (std::string& term : out.terms) rename(term, state.name, name);
        state.name = name;
        state.equation = in_words(effect.name) + ", " + name;
    }
    std::map<std::string, std::string> role_units = binding.role_units;
    role_units["equation"] = binding.unit;
    for (const EffectParameter& p : effect.parameters) {
        if (!texts.have(p.name)) continue;   // of an edit that reaches no equation
        const std::string name = names.fresh(p.name);
        texts.rename_everywhere(p.name, name);
        NewName added{name, unit_of_difference(units::tidy(filled_unit(p.unit, role_units))), 0.0, binding.in_output ? std::nullopt : p.min, false};
        added.neutral = filled(p.neutral, binding.roles[0]);
        out.names.push_back(std::move(added));
    }
    for (const EffectScan& s : effect.scans) {
        const std::string name = names.fresh(s.name);
        texts.rename_everywhere(s.name, name);
        NewName added{name, units::tidy(filled_unit(s.unit, role_units)), scan, s.fitted ? std::optional(0.0) : std::nullopt, !s.fitted};
        added.scanned = true;
        out.names.push_back(std::move(added));
    }
    if (!binding.freed.empty()) out.names.push_back(let_go(binding.freed, model));
    // The model's own names come in last: one of them may be spelled as a name that the effect brings.
    for (std::size_t k = 0; k < out.terms.size(); ++k) out.terms[k] = filled(out.terms[k], binding.roles[k]);
    for (Substitution& s : out.substitutions) {
        s.by = filled(s.by, s.roles);
        s.derivative = filled(s.derivative, s.roles);
        s.roles.clear();
    }
    for (std::size_t k = 0; k < out.states.size(); ++k) out.states[k].ode = filled(out.states[k].ode, binding.states[k].roles);
    return out;
}

std::string place(const Amendment& a, const model::Model& model) {
    if (!a.freed.empty()) return a.freed;
    std::string out;
    for (const std::size_t e : a.equations) join(out, model.equations[e].name);
    return out;
}

std::string change(const Amendment& a) {
    std::string out;
    for (const std::string& term : a.terms) if (!term.empty()) join(out, term);
    std::set<std::string> said;
    for (const Substitution& s : a.substitutions) {
        const std::string text = s.what + " -> " + s.by;
        if (said.insert(text).second) join(out, text);
    }
    for (const NewState& s : a.states) join(out, s.ode);
    if (!a.freed.empty()) join(out, a.freed + " is let go");
    return out;
}

std::string identity(const Amendment& a) {
    std::string out = a.effect + ":" + a.freed;
    for (const std::size_t e : a.equations) out += " " + std::to_string(e);
    for (const Substitution& s : a.substitutions) out += " " + s.what;
    return out;
}

}  // namespace algest::lab
