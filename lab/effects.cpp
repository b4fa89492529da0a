// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effects.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "generator/dimension.hpp"
#include "generator/units.hpp"
#include "lab/roles.hpp"
#include "lab/rotating_frame.hpp"

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
        e.outside = root["outside"].value_or(false);
        e.together = root["enters"]["together"].value_or(false);
        if (const toml::table* t = root["roles"].as_table()) for (const auto& [k, v] : *t) e.roles[std::string(k.str())] = v.value_or(std::string());
        e.term = root["rewrite"]["term"].value_or(std::string());
        e.d_term = root["rewrite"]["d"].value_or(std::string());
        e.q_term = root["rewrite"]["q"].value_or(std::string());
        if (const toml::array* a = root["parameter"].as_array()) {
            for (const auto& x : *a) if (const toml::table* t = x.as_table()) e.parameters.push_back({text_of(*t, "name"), text_of(*t, "unit"), (*t)["min"].value<double>().has_value()});
        }
        if (const toml::array* a = root["scan"].as_array()) {
            for (const auto& x : *a) if (const toml::table* t = x.as_table()) e.scans.push_back({text_of(*t, "name"), text_of(*t, "unit"), (*t)["from"].value_or(1.0), (*t)["to"].value_or(1.0), (*t)["step"].value_or(1.0), (*t)["spectrum"].value_or(false)});
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
    const auto frame = effect.d_term.empty() ? std::nullopt : rotating_frame(model, measured);
    for (std::size_t e = 0; e < model.equations.size(); ++e) {
        if (moved(model, model.equations[e]).signal < 0 || model.equations[e].sides.right == nullptr) continue;
        const Unit unit = model::unit_of_equation(model, model.equations[e]);
        const auto spelling = std::find_if(effect.units.begin(), effect.units.end(), [&](const std::string& u) { return fits(unit, u); });
        if (spelling == effect.units.end()) continue;
        if (frame && (e == frame->d_equation || e == frame->q_equation)) {
            const std::map<std::string, std::string> axes = {{"d", frame->d_current}, {"q", frame->q_current}, {"angle", frame->angle}};
            out.push_back({&effect, {e}, {e == frame->d_equation ? effect.d_term : effect.q_term}, {axes}, {}, *spelling});
            continue;
        }
        std::vector<Binding> open = {{&effect, {e}, {effect.term}, {{}}, {}, *spelling}};
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
    if (!effect.together || out.size() < 2) return out;
    Binding all = out[0];
    for (std::size_t k = 1; k < out.size(); ++k) {
        all.equations.push_back(out[k].equations[0]);
        all.terms.push_back(out[k].terms[0]);
        all.roles.push_back(out[k].roles[0]);
    }
    return {all};
}

}  // namespace algest::lab
