// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effect_edits.hpp"

#include <algorithm>

#include "generator/formula.hpp"
#include "generator/suggestion.hpp"
#include "generator/units.hpp"
#include "lab/placeholders.hpp"

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

constexpr const char* derivative = "derivative";   // {derivative}: the der() that is replaced

/// Every {name} as the name alone, and for each byte of that the byte of the text that it comes from.
struct Plain {
    std::string text;
    std::vector<std::size_t> from;
};

Plain without_braces(const std::string& text) {
    Plain out;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '{' || text[at] == '}') continue;
        out.text += text[at];
        out.from.push_back(at);
    }
    out.from.push_back(text.size());
    return out;
}

bool braces_pair(const std::string& text) { return std::count(text.begin(), text.end(), '{') == std::count(text.begin(), text.end(), '}'); }

}  // namespace

std::optional<std::string> role_in_braces(const std::string& text, const Effect& effect) {
    if (text.size() < 3 || text.front() != '{' || text.back() != '}') return std::nullopt;
    const std::string name = text.substr(1, text.size() - 2);
    return effect.roles.count(name) > 0 ? std::optional(name) : std::nullopt;
}

void EditReading::read(const toml::table& root, const toml::table& rewrite) {
    if (effect.rewrite == Rewrite::free_constant) {
        effect.freed = role(rewrite, "what", "{constant}");
        for (const char* key : {"edit", "state", "parameter", "scan"}) if (root.contains(key)) file.error(*root.get(key), "[[" + std::string(key) + "]] beside kind = \"free_constant\"", "the constant itself is what is fitted: leave it out");
        return;
    }
    if (!root.contains("edit")) file.error(rewrite, "no [[edit]]", "write what is replaced: what = \"{current}\", by = \"{current} - b\"");
    file.each_table(root, "edit", [&](const toml::table& t) { read_edit(t); });
    const bool brings_states = effect.rewrite == Rewrite::add_state;
    if (brings_states && !root.contains("state")) file.error(rewrite, "no [[state]]", "declare it: name = \"u_act\", unit = \"{input}\", equation = \"tau*der(u_act) = {input} - u_act\"");
    if (!brings_states && root.contains("state")) file.error(*root.get("state"), "[[state]] beside another kind than add_state", "write kind = \"add_state\"");
    std::size_t k = 0;
    file.each_table(root, "state", [&](const toml::table& t) { if (k < effect.states.size()) read_state(t, effect.states[k++]); });
}

void EditReading::read_edit(const toml::table& t) {
    file.known_keys(t, {"in", "add", "what", "at", "by", "derivative"});
    EffectEdit edit;
    file.choose<Reach>(t, "in", {{"own", Reach::own}, {"all", Reach::all}, {"fed", Reach::fed}, {"d", Reach::d}, {"q", Reach::q}, {"torque", Reach::torque}}, edit.in, "reach of an edit");
    file.choose<Part>(t, "at", {{"everywhere", Part::everywhere}, {"leading", Part::leading}, {"elsewhere", Part::elsewhere}}, edit.part, "part of an equation");
    if (t.contains("add")) {
        for (const char* key : {"what", "at", "by", "derivative"}) if (t.contains(key)) file.error(*t.get(key), quoted(key) + " beside 'add'", "make it an [[edit]] of its own");
        edit.add = formula(t, "add", true, "-c*{speed}");
    } else {
        edit.what = role(t, "what", "{current}");
        edit.by = formula(t, "by", true, "{current} - b");
        edit.derivative = formula(t, derivative, false, "{derivative}/g");
    }
    effect.edits.push_back(std::move(edit));
}

void EditReading::read_state(const toml::table& t, EffectState& state) {
    file.known_keys(t, {"name", "unit", "initial", "equation"});
    state.unit = file.string(t, "unit").value_or("");
    std::map<std::string, std::string> stand_in;
    for (const auto& [role, kind] : effect.roles) stand_in[role] = "m";
    if (const auto fault = state.unit.empty() ? std::nullopt : units::fault_of_unit(filled(state.unit, stand_in))) file.error(*t.get("unit"), fault->what, fault->right);
    if (const auto initial = file.number(t, "initial")) state.initial = exact::nearest(*initial, plan::Scalar::float64);
    state.ode = formula(t, "equation", true, "tau*der(u_act) = {input} - u_act");
}

std::string EditReading::role(const toml::table& t, const char* key, const std::string& example) {
    const auto text = file.string(t, key);
    if (!t.contains(key)) file.error(t, "no " + std::string(key), "add " + std::string(key) + " = \"" + example + "\"");
    if (!text) return "";
    const auto found = role_in_braces(*text, effect);
    if (found) used.insert(*text);
    else file.error(*t.get(key), quoted(*text) + " is no role", "write one of [roles] in braces: " + example);
    return found.value_or("");
}

std::string EditReading::formula(const toml::table& t, const char* key, bool needed, const std::string& example) {
    const auto text = file.string(t, key);
    if (!t.contains(key)) {
        if (needed) file.error(t, "no " + std::string(key), "add " + std::string(key) + " = \"" + example + "\"");
        return "";
    }
    if (!text) return "";
    if (text->empty()) file.error(*t.get(key), quoted(key) + " is empty", "write " + std::string(key) + " = \"" + example + "\"");
    else if (names_known) check_formula(*text, *t.get(key));
    return *text;
}

void EditReading::check_formula(const std::string& text, const toml::node& node) {
    const Plain plain = without_braces(text);
    const auto places = file.places(node, text.size());
    const auto complain = [&](int offset, const std::string& what, const std::string& right) {
        file.error(places[plain.from[std::min(static_cast<std::size_t>(std::max(offset, 0)), plain.from.size() - 1)]], what, right);
    };
    if (!braces_pair(text)) return file.error(node, "'{' and '}' do not pair", "a placeholder is written {speed}");
    std::vector<Formula> sides;
    if (text.find('=') == std::string::npos) {
        if (const auto parsed = formula::parse(plain.text, complain)) sides = {*parsed};
    } else if (const auto parsed = formula::parse_equation(plain.text, complain)) {
        sides = {parsed->left, parsed->right};
    }
    std::vector<std::string> known = {derivative};
    for (const auto& [name, kind] : effect.roles) known.push_back(name);
    for (const EffectParameter& p : effect.parameters) known.push_back(p.name);
    for (const EffectScan& s : effect.scans) known.push_back(s.name);
    for (const EffectState& s : effect.states) known.push_back(s.name);
    const std::function<void(const Formula&)> look = [&](const Formula& f) {
        for (const Formula& a : f->arguments) look(a);
        if (f->kind != Kind::name) return;
        const bool braced = plain.from[static_cast<std::size_t>(f->offset)] > 0 && text[plain.from[static_cast<std::size_t>(f->offset)] - 1] == '{';
        const bool role = f->name == derivative || effect.roles.count(f->name) > 0;
        if (std::find(known.begin(), known.end(), f->name) == known.end()) complain(f->offset, "unknown name " + quoted(f->name), did_you_mean(f->name, known) + "declare it under [roles], [[parameter]], [[scan]] or [[state]]");
        else if (role != braced) complain(f->offset, quoted(f->name) + (role ? " stands without braces" : " stands in braces"), role ? "write {" + f->name + "}" : "write " + f->name);
        else used.insert(role ? "{" + f->name + "}" : f->name);
    };
    for (const Formula& side : sides) look(side);
}

}  // namespace algest::lab
