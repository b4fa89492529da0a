// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effects.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "generator/dimension.hpp"
#include "generator/units.hpp"
#include "lab/effect_file.hpp"
#include "lab/roles.hpp"
#include "lab/rotating_frame.hpp"

namespace algest::lab {

using units::Unit;

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
