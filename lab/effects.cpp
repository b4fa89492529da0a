// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effects.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include "generator/dimension.hpp"
#include "generator/equation_unit.hpp"
#include "generator/units.hpp"
#include "lab/bound_edits.hpp"
#include "lab/couplings.hpp"
#include "lab/effect_file.hpp"
#include "lab/outputs.hpp"
#include "lab/roles.hpp"
#include "lab/rotating_frame.hpp"

namespace algest::lab {

using units::Unit;

namespace {

/// The same unit, not another multiple of it.
bool is(const Unit& unit, const std::string& text) { return fits(unit, text) && std::abs(unit.factor_to(*Unit::parse(text)) - 1) < 1e-9; }

/// The unit of an equation that the effect may enter, as a text that UDUNITS reads, multiples such as cm^3/s kept; empty: unknown, or the effect
/// names none and fits every equation. Nullopt: it may not enter. A balance stays one when it is divided by its inertia, or written in amperes.
std::optional<std::string> unit_that_fits(const Effect& effect, const model::Model& model, std::size_t equation) {
    if (effect.units.empty()) return "";
    const model::Equation& e = model.equations[equation];
    const Unit unit = model::unit_of_equation(model, e);
    for (const std::string& u : effect.units) if (fits(unit, u)) return is(unit, u) ? u : model::equation_unit(model, e);
    const std::string balance = balanced(model, e);
    if (balance.empty() || std::find(effect.units.begin(), effect.units.end(), balance) == effect.units.end()) return std::nullopt;
    const Moved own = moved(model, e);
    const std::string& of_signal = model.signals[static_cast<std::size_t>(own.signal)].unit;
    const std::string rate = of_signal.empty() ? "" : own.order == 1 ? "(" + of_signal + ")/s" : "(" + of_signal + ")/s^" + std::to_string(own.order);
    return !unit.known() ? "" : is(unit, rate) ? rate : model::equation_unit(model, e);
}

/// Every combination of what may stand for the roles in an equation.
std::vector<Binding> with_roles(const Effect& effect, const model::Model& model, std::size_t equation, const std::vector<bool>& measured, const std::string& unit) {
    std::vector<Binding> open = {{&effect, {equation}, {effect.term}, {{}}, {}, unit}};
    open[0].in_output = output_of(model, model.equations[equation]) >= 0;
    for (const auto& [role, kind] : effect.roles) {
        std::vector<Binding> next;
        const std::vector<Filler> choices = fillers(kind, model, equation, measured);
        for (const Binding& b : open) {
            for (const Filler& filler : choices) {
                Binding bound = b;
                bound.roles[0][role] = filler.formula;
                bound.role_units[role] = filler.unit;
                next.push_back(std::move(bound));
            }
        }
        open = std::move(next);
    }
    return open;
}

/// One binding to all places at once.
Binding joined(const std::vector<Binding>& places) {
    Binding all = places[0];
    for (std::size_t k = 1; k < places.size(); ++k) {
        const Binding& b = places[k];
        all.equations.insert(all.equations.end(), b.equations.begin(), b.equations.end());
        all.terms.insert(all.terms.end(), b.terms.begin(), b.terms.end());
        all.roles.insert(all.roles.end(), b.roles.begin(), b.roles.end());
        for (Substitution s : b.substitutions) {
            s.state_set = k;
            all.substitutions.push_back(std::move(s));
        }
        for (BoundState s : b.states) {
            s.state_set = k;
            all.states.push_back(std::move(s));
        }
    }
    return all;
}

/// All places at once whose roles have the same units: a voltage and a way have no amplifier in common.
std::vector<Binding> joined_by_unit(std::vector<Binding> places) {
    std::vector<Binding> out;
    while (!places.empty()) {
        const auto units = places[0].role_units;
        const auto rest = std::stable_partition(places.begin(), places.end(), [&](const Binding& b) { return b.role_units == units; });
        std::vector<Binding> alike(std::make_move_iterator(places.begin()), std::make_move_iterator(rest));
        places.erase(places.begin(), rest);
        out.push_back(alike.size() > 1 ? joined(alike) : std::move(alike[0]));
    }
    return out;
}

}  // namespace

std::vector<Effect> read_effects(const std::vector<std::string>& folders, Diagnostics& diagnostics) {
    std::map<std::string, Effect> by_name;
    for (const std::string& folder : folders) {
        std::error_code error;
        std::set<std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder, error)) if (entry.path().extension() == ".toml") files.insert(entry.path().string());
        std::map<std::string, std::string> here;   // name -> file
        for (const std::string& file : files) {
            auto effect = read_effect(file, diagnostics);
            if (!effect) continue;
            const auto [first, fresh] = here.emplace(effect->name, file);
            if (fresh) by_name[effect->name] = std::move(*effect);
            else diagnostics.error(file, effect->at, algest::quoted(effect->name) + " is an effect of " + first->second + " as well", "give each its own name, or remove one");
        }
    }
    std::vector<Effect> out;
    for (auto& [name, effect] : by_name) out.push_back(std::move(effect));
    return out;
}

std::vector<Binding> bindings(const Effect& effect, const model::Model& model, const std::vector<bool>& measured) {
    std::vector<Binding> out;
    const auto frame = effect.d_term.empty() ? std::nullopt : rotating_frame(model, measured);
    for (std::size_t e = 0; e < model.equations.size(); ++e) {
        if (model.equations[e].sides.right == nullptr) continue;
        if (moved(model, model.equations[e]).signal < 0 && output_of(model, model.equations[e]) < 0) continue;
        const auto unit = unit_that_fits(effect, model, e);
        if (!unit) continue;
        if (frame && (e == frame->d_equation || e == frame->q_equation)) {
            const std::map<std::string, std::string> axes = {{"d", frame->d_current}, {"q", frame->q_current}, {"angle", frame->angle}};
            out.push_back({&effect, {e}, {e == frame->d_equation ? effect.d_term : effect.q_term}, {axes}, {}, *unit});
            continue;
        }
        for (Binding& b : with_roles(effect, model, e, measured, *unit)) {
            if (effect.rewrite == Rewrite::add_term) out.push_back(std::move(b));
            else if (bind_edits(b, model, measured) && !is_bound_already(b, out)) out.push_back(std::move(b));
        }
    }
    if (effect.rewrite == Rewrite::add_term) {
        std::vector<std::optional<std::string>> unit_of;
        for (std::size_t e = 0; e < model.equations.size(); ++e) unit_of.push_back(moved(model, model.equations[e]).signal < 0 ? std::nullopt : unit_that_fits(effect, model, e));
        for (Binding& b : bindings_between_bodies(effect, model, measured, unit_of)) out.push_back(std::move(b));
    }
    return effect.together ? joined_by_unit(std::move(out)) : out;
}

}  // namespace algest::lab
