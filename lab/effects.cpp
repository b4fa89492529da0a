// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effects.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "generator/dimension.hpp"
#include "generator/units.hpp"

namespace algest::lab {

namespace {

using units::Unit;

std::string text_of(const toml::table& t, const char* key) { return t[key].value_or(std::string()); }

std::optional<Effect> read_effect(const std::string& path, Diagnostics& diagnostics) {
    try {
        const toml::table root = toml::parse_file(path);
        Effect e;
        e.name = text_of(root, "name");
        e.summary = text_of(root, "summary");
        e.shows = text_of(root, "shows");
        e.reference = text_of(root, "reference");
        if (const toml::array* a = root["aliases"].as_array()) for (const auto& x : *a) e.aliases.push_back(x.value_or(std::string()));
        if (const toml::array* a = root["enters"]["units"].as_array()) for (const auto& x : *a) e.units.push_back(x.value_or(std::string()));
        e.together = root["enters"]["together"].value_or(false);
        if (const toml::table* t = root["roles"].as_table()) for (const auto& [k, v] : *t) e.roles[std::string(k.str())] = v.value_or(std::string());
        e.term = root["rewrite"]["term"].value_or(std::string());
        if (const toml::array* a = root["parameter"].as_array()) {
            for (const auto& x : *a) if (const toml::table* t = x.as_table()) e.parameters.push_back({text_of(*t, "name"), text_of(*t, "unit"), (*t)["min"].value<double>().has_value()});
        }
        if (const toml::array* a = root["scan"].as_array()) {
            for (const auto& x : *a) if (const toml::table* t = x.as_table()) e.scans.push_back({text_of(*t, "name"), text_of(*t, "unit"), (*t)["from"].value_or(1.0), (*t)["to"].value_or(1.0), (*t)["step"].value_or(1.0)});
        }
        if (const toml::array* a = root["rival"].as_array()) {
            for (const auto& x : *a) if (const toml::table* t = x.as_table()) e.rivals.push_back({text_of(*t, "name"), text_of(*t, "experiment")});
        }
        if (e.name.empty() || e.term.empty() || e.parameters.empty() || e.units.empty()) {
            diagnostics.error(path, {1, 1}, "an effect needs name, [enters] units, [rewrite] term and [[parameter]]", "see docs/discover.md");
            return std::nullopt;
        }
        return e;
    } catch (const toml::parse_error& error) {
        diagnostics.error(path, {static_cast<int>(error.source().begin.line), static_cast<int>(error.source().begin.column)}, "not TOML: " + std::string(error.description()), "see docs/discover.md");
        return std::nullopt;
    }
}

bool fits(const Unit& unit, const std::string& wanted) {
    const auto w = Unit::parse(wanted);
    return w && unit.known() && unit.same_dimension(*w);
}

Unit unit_of(const model::Signal& signal) { return signal.unit.empty() ? Unit() : Unit::parse(signal.unit).value_or(Unit()); }

/// The signal that an equation moves: that of its first highest derivative, with the order.
struct Moved {
    int signal = -1;
    int order = 0;
};

void find_highest(const formula::Formula& f, const model::Model& model, Moved& out) {
    if (f->kind == formula::Kind::call && f->name == "der") {
        const int order = f->arguments.size() > 1 ? cln::cl_I_to_int(cln::numerator(f->arguments[1]->value)) : 1;
        if (order > out.order) out = {model.signal_index(f->arguments[0]->name), order};
    }
    for (const formula::Formula& a : f->arguments) find_highest(a, model, out);
}

Moved moved(const model::Equation& e, const model::Model& model) {
    Moved out;
    find_highest(e.sides.left, model, out);
    find_highest(e.sides.right, model, out);
    return out;
}

/// The signal x with an equation der(x) = speed.
int integral_of(int speed, const model::Model& model) {
    for (const model::Equation& e : model.equations) {
        const auto is_rate = [&](const formula::Formula& a, const formula::Formula& b) {
            return a->kind == formula::Kind::call && a->name == "der" && a->arguments.size() == 1 && b->kind == formula::Kind::name && model.signal_index(b->name) == speed;
        };
        if (is_rate(e.sides.left, e.sides.right)) return model.signal_index(e.sides.left->arguments[0]->name);
        if (is_rate(e.sides.right, e.sides.left)) return model.signal_index(e.sides.right->arguments[0]->name);
    }
    return -1;
}

struct Filler {
    std::string formula;
    std::string unit;
};

/// What may stand for a role in an equation.
std::vector<Filler> fillers(const std::string& kind, const model::Model& model, std::size_t equation, const std::vector<bool>& measured) {
    const Moved own = moved(model.equations[equation], model);
    if (own.signal < 0) return {};
    const model::Signal& signal = model.signals[static_cast<std::size_t>(own.signal)];
    const Unit unit = unit_of(signal);
    const bool is_speed = own.order == 1 && (fits(unit, "rad/s") || fits(unit, "m/s"));
    const bool is_position = own.order == 2 && (fits(unit, "rad") || fits(unit, "m"));
    std::vector<Filler> out;
    if (kind == "own") out.push_back({signal.name, signal.unit});
    if (kind == "current" && fits(unit, "A")) out.push_back({signal.name, signal.unit});
    if (kind == "speed") {
        if (is_speed) out.push_back({signal.name, signal.unit});
        if (is_position) out.push_back({"der(" + signal.name + ")", "(" + signal.unit + ")/s"});
    }
    if (kind == "angle" || kind == "position") {
        const int x = is_position ? own.signal : is_speed ? integral_of(own.signal, model) : -1;
        if (x >= 0) {
            const model::Signal& position = model.signals[static_cast<std::size_t>(x)];
            if (kind == "position" || fits(unit_of(position), "rad")) out.push_back({position.name, position.unit.empty() ? "1" : position.unit});
        }
    }
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const Unit u = unit_of(model.signals[s]);
        const bool moves = std::any_of(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return moved(e, model).signal == static_cast<int>(s); });
        if (!measured[s]) continue;
        if (kind == "any_speed" && static_cast<int>(s) != own.signal && (fits(u, "rad/s") || fits(u, "m/s"))) out.push_back({model.signals[s].name, model.signals[s].unit});
        if (kind == "input" && !moves) out.push_back({model.signals[s].name, model.signals[s].unit.empty() ? "1" : model.signals[s].unit});
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
        for (const std::string& file : files) {
            auto effect = read_effect(file, diagnostics);
            if (effect) by_name[effect->name] = std::move(*effect);
        }
    }
    std::vector<Effect> out;
    for (auto& [name, effect] : by_name) out.push_back(std::move(effect));
    return out;
}

std::vector<Binding> bindings(const Effect& effect, const model::Model& model, const std::vector<bool>& measured) {
    std::vector<Binding> out;
    for (std::size_t e = 0; e < model.equations.size(); ++e) {
        if (moved(model.equations[e], model).signal < 0 || model.equations[e].sides.right == nullptr) continue;
        const Unit unit = model::unit_of_equation(model, model.equations[e]);
        const auto spelling = std::find_if(effect.units.begin(), effect.units.end(), [&](const std::string& u) { return fits(unit, u); });
        if (spelling == effect.units.end()) continue;
        std::vector<Binding> open = {{&effect, {e}, {{}}, {}, *spelling}};
        for (const auto& [role, kind] : effect.roles) {
            std::vector<Binding> next;
            for (const Binding& b : open) {
                for (const Filler& filler : fillers(kind, model, e, measured)) {
                    Binding bound = b;
                    bound.roles[0][role] = filler.formula;
                    bound.role_units[role] = filler.unit;
                    next.push_back(std::move(bound));
                }
            }
            open = std::move(next);
        }
        out.insert(out.end(), open.begin(), open.end());
    }
    if (effect.together && out.size() > 1) {
        Binding all = out[0];
        for (std::size_t k = 1; k < out.size(); ++k) {
            all.equations.push_back(out[k].equations[0]);
            all.roles.push_back(out[k].roles[0]);
        }
        out.push_back(all);
    }
    return out;
}

}  // namespace algest::lab
