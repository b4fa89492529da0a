// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/couplings.hpp"

#include <algorithm>

#include "generator/dimension.hpp"
#include "lab/equation_places.hpp"
#include "lab/roles.hpp"
#include "lab/turned.hpp"

namespace algest::lab {

namespace {

/// The effect is an added term, and all that it hangs on is how a body moves.
bool hangs_on_motion(const Effect& effect) {
    const auto is_motion = [](const auto& role) { return role.second == "speed" || role.second == "position"; };
    return effect.rewrite == Rewrite::add_term && !effect.together && !effect.roles.empty() && std::all_of(effect.roles.begin(), effect.roles.end(), is_motion);
}

bool share_difference(const model::Model& model, const model::Equation& e, const Filler& a, const Filler& b) {
    const auto all = differences(model, e);
    return std::any_of(all.begin(), all.end(), [&](const auto& d) { return (d.first == a.formula && d.second == b.formula) || (d.first == b.formula && d.second == a.formula); });
}

/// "(a-b)" of what two equations have for a role; empty: one of them has nothing.
Filler difference_of(const std::string& kind, const model::Model& model, std::size_t one, std::size_t other, const std::vector<bool>& measured) {
    const std::vector<Filler> a = fillers(kind, model, one, measured);
    const std::vector<Filler> b = fillers(kind, model, other, measured);
    if (a.size() != 1 || b.size() != 1 || a[0].unit != b[0].unit) return {};
    return {"(" + a[0].formula + "-" + b[0].formula + ")", a[0].unit};
}

bool are_coupled(const model::Model& model, std::size_t one, std::size_t other, const std::vector<bool>& measured) {
    for (const char* kind : {"position", "speed"}) {
        const std::vector<Filler> a = fillers(kind, model, one, measured);
        const std::vector<Filler> b = fillers(kind, model, other, measured);
        if (a.size() != 1 || b.size() != 1) continue;
        if (share_difference(model, model.equations[one], a[0], b[0]) && share_difference(model, model.equations[other], a[0], b[0])) return true;
    }
    return false;
}

/// Its terms are forces or torques: one that was divided by its inertia, or written in amperes, knows what acts on the body by a factor of its own,
/// and one parameter does not say the same in two of them.
bool balances_forces(const model::Model& model, const model::Equation& e) {
    const units::Unit unit = model::unit_of_equation(model, e);
    return fits(unit, "N") || fits(unit, "N.m");
}

/// Parentheses around a placeholder that brings its own go.
std::string without_double_parentheses(std::string term, const std::map<std::string, std::string>& roles) {
    for (const auto& [role, formula] : roles) {
        const std::string twice = "({" + role + "})";
        for (std::size_t at = term.find(twice); at != std::string::npos; at = term.find(twice)) term.replace(at, twice.size(), "{" + role + "}");
    }
    return term;
}

}  // namespace

std::vector<Binding> bindings_between_bodies(const Effect& effect, const model::Model& model, const std::vector<bool>& measured, const std::vector<std::optional<std::string>>& unit_of) {
    std::vector<Binding> out;
    if (!hangs_on_motion(effect)) return out;
    for (std::size_t one = 0; one < model.equations.size(); ++one) {
        if (!unit_of[one] || !balances_forces(model, model.equations[one])) continue;
        for (std::size_t other = one + 1; other < model.equations.size(); ++other) {
            if (unit_of[one] != unit_of[other] || !balances_forces(model, model.equations[other]) || !are_coupled(model, one, other, measured)) continue;
            Binding b{&effect, {one, other}, {}, {}, {}, *unit_of[one]};
            std::map<std::string, std::string> roles;
            for (const auto& [role, kind] : effect.roles) {
                const Filler filler = difference_of(kind, model, one, other, measured);
                if (filler.formula.empty()) continue;
                roles[role] = filler.formula;
                b.role_units[role] = filler.unit;
            }
            if (roles.size() < effect.roles.size()) continue;
            const std::string term = without_double_parentheses(effect.term, roles);
            b.terms = {term, turned(term)};
            b.roles = {roles, roles};
            out.push_back(std::move(b));
        }
    }
    return out;
}

}  // namespace algest::lab
