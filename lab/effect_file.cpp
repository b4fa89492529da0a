// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effect_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "generator/names.hpp"
#include "generator/suggestion.hpp"
#include "generator/toml_file.hpp"
#include "generator/units.hpp"
#include "lab/effect_edits.hpp"
#include "lab/effect_term.hpp"
#include "lab/placeholders.hpp"
#include "lab/roles.hpp"

namespace algest::lab {

namespace {

using model::PlacedText;
using model::TomlAccess;

constexpr std::size_t most_roles = 6;       // each is bound to every signal that may stand for it, in all combinations
constexpr double most_scanned = 10000;      // values; each is tried in every equation that the effect may enter

/// An effect file while it is read.
class Reading {
public:
    Reading(TomlAccess& file, Effect& effect) : file_(file), effect_(effect) {}

    void read(const toml::table& root) {
        file_.known_keys(root, {"format", "name", "aliases", "summary", "shows", "reference", "outside", "enters", "roles", "rewrite", "edit", "state", "parameter", "scan", "rival"});
        read_head(root);
        read_kind(root);
        if (const toml::table* t = entered_table(root)) read_enters(*t);
        if (const toml::table* t = file_.subtable(root, "roles")) read_roles(*t);
        for (const char* key : {"roles", "parameter", "scan"}) names_known_ = names_known_ && is_declared_right(root, key);
        read_names_of_states(root);
        const toml::table* rewrite = needed_table(root, "rewrite", "write what it adds: kind = \"add_term\", term = \"-Tc*sgn({speed})\"");
        in_a_frame_ = rewrite != nullptr && rewrite->contains("d");
        if (effect_.rewrite == Rewrite::add_term) {
            for (const char* key : {"edit", "state"}) if (root.contains(key)) file_.error(*root.get(key), "[[" + std::string(key) + "]] beside kind = \"add_term\"", "write another kind, or leave it out");
        }
        file_.each_table(root, "parameter", [&](const toml::table& t) { read_parameter(t); });
        if (!root.contains("parameter") && needs_a_parameter(root)) file_.error(top, "no [[parameter]]", "declare what is fitted: name = \"Tc\", unit = \"{equation}\"");
        file_.each_table(root, "scan", [&](const toml::table& t) { read_scan(t); });
        file_.each_table(root, "rival", [&](const toml::table& t) { read_rival(t); });
        if (rewrite == nullptr) return;
        if (effect_.rewrite == Rewrite::add_term) read_rewrite(*rewrite);
        else read_edits(root, *rewrite);
    }

private:
    static constexpr Position top = {1, 1};

    /// What the rewrite does decides what else there has to be.
    void read_kind(const toml::table& root) {
        const toml::node* node = root.get("rewrite");
        if (node == nullptr || !node->is_table()) return;
        file_.choose<Rewrite>(*node->as_table(), "kind", {{"add_term", Rewrite::add_term}, {"replace", Rewrite::replace}, {"transform_signal", Rewrite::transform_signal},
                                                           {"add_state", Rewrite::add_state}, {"free_constant", Rewrite::free_constant}}, effect_.rewrite, "kind of rewrite");
    }

    bool needs_a_parameter(const toml::table& root) const {
        const bool bends = effect_.rewrite == Rewrite::replace || effect_.rewrite == Rewrite::transform_signal;
        return effect_.rewrite == Rewrite::add_term || (bends && !root.contains("scan"));
    }

    /// A term has the unit of an equation; what else is done to an equation does not hang on it.
    const toml::table* entered_table(const toml::table& root) {
        if (effect_.rewrite != Rewrite::add_term && !root.contains("enters")) return nullptr;
        return needed_table(root, "enters", "say which equations it may enter: units = [\"N.m\"]");
    }

    const toml::table* needed_table(const toml::table& root, std::string_view key, const std::string& right) {
        if (!root.contains(key)) file_.error(top, "no [" + std::string(key) + "]", right);
        return file_.subtable(root, key);
    }

    /// False for a section of another type, of which there is a complaint elsewhere: the names that it was to declare are not known.
    bool is_declared_right(const toml::table& root, const std::string& key) const {
        const toml::node* node = root.get(key);
        return node == nullptr ? key != "parameter" || !needs_a_parameter(root) : key == "roles" ? node->is_table() : node->is_array_of_tables();
    }

    /// A text that must be there and say something; empty after a complaint. at: of the table it is missing from.
    std::string needed(const toml::table& t, Position at, std::string_view key, const std::string& example) {
        const auto text = file_.string(t, key);
        if (!t.contains(key)) file_.error(at, "no " + std::string(key), "add " + std::string(key) + " = \"" + example + "\"");
        else if (text && text->empty()) file_.error(*t.get(key), quoted(key) + " is empty", "write " + std::string(key) + " = \"" + example + "\"");
        return text.value_or("");
    }

    /// The same, as it goes into comments and reports.
    std::string prose(const toml::table& t, Position at, std::string_view key, const std::string& example) {
        std::string text = needed(t, at, key, example);
        if (model::fault_of_prose(text)) {
            file_.error(*t.get(key), quoted(key) + " is not one plain line", "write at most 300 characters without line breaks, {{ }} and /* */: they go into comments");
        }
        return text;
    }

    /// The same, where only people miss it: a warning.
    std::string for_the_reader(const toml::table& root, std::string_view key, const std::string& example) {
        if (root.contains(key)) return prose(root, top, key, example);
        file_.warning(top, "no " + std::string(key), "add " + std::string(key) + " = \"" + example + "\"");
        return "";
    }

    void check_effect_name(const std::string& name, Position at) {
        if (!model::is_lower_case_name(name)) file_.error(at, quoted(name) + " is not the name of an effect", "use lower case, digits and single _, a letter first: coulomb_friction");
    }

    void read_head(const toml::table& root) {
        effect_.name = needed(root, top, "name", "seal_friction");
        if (!effect_.name.empty()) {
            effect_.at = model::position(*root.get("name"));
            check_effect_name(effect_.name, effect_.at);
        }
        for (PlacedText& alias : file_.strings(root, "aliases", "[\"dry_friction\"]")) {
            check_effect_name(alias.text, alias.at);
            effect_.aliases.push_back(std::move(alias.text));
        }
        effect_.summary = prose(root, top, "summary", "friction of a seal");
        effect_.shows = for_the_reader(root, "shows", "the residual jumps where the speed changes its sign");
        effect_.reference = for_the_reader(root, "reference", "a book, a paper, your own measurement");
        effect_.outside = file_.boolean(root, "outside").value_or(false);
    }

    void read_enters(const toml::table& t) {
        file_.known_keys(t, {"units", "together"});
        const bool missing = !t.contains("units");
        if (missing && effect_.rewrite != Rewrite::add_term) {
            effect_.together = file_.boolean(t, "together").value_or(false);
            return;
        }
        std::vector<PlacedText> units = file_.strings(t, "units", "[\"N.m\", \"N\"]");
        if (missing || (t.get("units")->is_array() && t.get("units")->as_array()->empty())) {
            file_.error(missing ? model::position(t) : model::position(*t.get("units")), "no units of equations that it may enter", "write units = [\"N.m\", \"N\"]");
        }
        for (PlacedText& unit : units) {
            if (const auto fault = units::fault_of_unit(unit.text)) file_.error(unit.at, fault->what, fault->right);
            effect_.units.push_back(std::move(unit.text));
        }
        effect_.together = file_.boolean(t, "together").value_or(false);
    }

    /// Before anything refers to them.
    void read_names_of_states(const toml::table& root) {
        if (effect_.rewrite == Rewrite::add_term) return;
        file_.each_table(root, "state", [&](const toml::table& t) { effect_.states.push_back({take_name(t, "u_act"), "", 0, ""}); });
    }

    void read_roles(const toml::table& t) {
        std::vector<std::pair<std::string, std::string>> kinds;
        for (const RoleKind& k : role_kinds()) kinds.emplace_back(k.name, k.name);
        file_.each_named(t, [&](const std::string& role, Position at, const toml::node&) {
            if (!take_name(role, at)) return;
            if (effect_.roles.size() == most_roles) {
                file_.error(at, "more than " + std::to_string(most_roles) + " roles", "an effect needs no more");
                names_known_ = false;
                return;
            }
            std::string kind;
            file_.choose(t, role, kinds, kind, "kind of role");
            effect_.roles[role] = kind;
            if (!kind.empty()) role_places_[role] = at;
        });
    }

    /// Roles, parameters and scanned numbers stand in one term: each needs a name of its own.
    bool take_name(const std::string& name, Position at) {
        const auto [place, fresh] = names_.emplace(model::folded(name), name);
        if (const auto fault = model::fault_of_name(name)) file_.error(at, fault->what, fault->right);
        else if (name == "equation") file_.error(at, "'equation' stands for the unit of the equation", "choose another name");
        else if (fresh) return true;
        else if (place->second == name) file_.error(at, quoted(name) + " is declared twice", "give each its own name");
        else file_.error(at, quoted(name) + " and " + quoted(place->second) + " differ by case alone", "rename one of them");
        names_known_ = false;
        return false;
    }

    std::string take_name(const toml::table& t, const std::string& example) {
        const std::string name = needed(t, model::position(t), "name", example);
        if (name.empty()) names_known_ = false;
        if (name.empty() || !take_name(name, model::position(*t.get("name")))) return "";
        places_[name] = model::position(*t.get("name"));
        return name;
    }

    /// A unit with placeholders; may be empty, and then goes unchecked.
    std::string unit_of(const toml::table& t, const std::string& example) {
        const auto text = file_.string(t, "unit");
        if (!t.contains("unit")) file_.error(t, "no unit", "add unit = \"" + example + "\"; \"\" goes unchecked");
        if (!text) return "";
        std::map<std::string, std::string> stand_in = {{"equation", "m"}};
        if (!in_a_frame_) for (const auto& [role, kind] : effect_.roles) stand_in[role] = "m";   // a frame's axes have no unit of their own
        const std::string plain = filled(*text, stand_in);
        const toml::node& node = *t.get("unit");
        if (const std::size_t brace = plain.find_first_of("{}"); brace != std::string::npos) {
            std::string known;
            for (const auto& [name, unit] : stand_in) known += (known.empty() ? "{" : ", {") + name + "}";
            file_.error(node, "nothing stands for " + quoted(plain.substr(brace, plain.find('}', brace) - brace + 1)), "placeholders of a unit here: " + known);
        } else if (const auto fault = units::fault_of_unit(plain)) {
            file_.error(node, plain == *text ? fault->what : quoted(*text) + " is no unit, whatever stands for its placeholders", plain == *text ? fault->right : "write {equation}/({speed})^2");
        }
        return *text;
    }

    void read_parameter(const toml::table& t) {
        file_.known_keys(t, {"name", "unit", "min", "neutral"});
        EffectParameter p{take_name(t, "Tc"), unit_of(t, "{equation}"), std::nullopt};
        read_neutral(t, p);
        if (const auto min = file_.number(t, "min")) p.min = exact::nearest(*min, plan::Scalar::float64);
        if (!p.name.empty()) effect_.parameters.push_back(std::move(p));
    }

    /// A number, or the {role} of a parameter or constant.
    void read_neutral(const toml::table& t, EffectParameter& p) {
        const toml::node* node = t.get("neutral");
        if (node == nullptr) return;
        if (effect_.rewrite == Rewrite::add_term) {
            file_.error(*node, "'neutral' of a term", "a term does nothing where its parameter is 0: leave it out");
        } else if (!node->is_string()) {
            if (const auto value = file_.number(t, "neutral")) p.neutral = fmt::format("{}", exact::nearest(*value, plan::Scalar::float64));
        } else if (const auto role = role_in_braces(*node->value<std::string>(), effect_)) {
            p.neutral = "{" + *role + "}";
        } else {
            file_.error(*node, quoted(*node->value<std::string>()) + " is no value at which the effect does nothing", "write a number, or the {role} of what it replaces");
        }
    }

    void read_scan(const toml::table& t) {
        file_.known_keys(t, {"name", "unit", "from", "to", "step", "factor", "of", "fitted", "spectrum"});
        if (effect_.scans.size() == 1) {
            file_.error(t, "a second [[scan]]", "an effect scans one number at most");
            names_known_ = false;
            return;
        }
        EffectScan s{take_name(t, "N"), unit_of(t, "1"), 1, 1, 1, file_.boolean(t, "spectrum").value_or(false)};
        s.fitted = file_.boolean(t, "fitted").value_or(false);
        read_reference(t, s);
        if (s.spectrum) read_spectrum(t, s);
        else read_range(t, s);
        effect_.scans.push_back(std::move(s));   // nameless after a complaint: a second one is still one too many
    }

    void read_spectrum(const toml::table& t, const EffectScan& s) {
        for (const char* key : {"from", "to", "step", "factor", "of", "fitted"}) if (t.contains(key)) file_.error(*t.get(key), quoted(key) + " beside spectrum = true", "leave one of the two out");
        const auto unit = units::Unit::parse(s.unit);
        const auto wanted = units::Unit::parse("rad/s");
        const bool fits = unit && unit->same_dimension(*wanted) && unit->factor_to(*wanted) == 1.0;
        if (t.contains("unit") && unit && !fits) file_.error(*t.get("unit"), "a number of the spectrum in " + quoted(s.unit), "write unit = \"rad/s\"");
    }

    /// What the range is counted in.
    void read_reference(const toml::table& t, EffectScan& s) {
        const auto of = file_.string(t, "of");
        if (!of) return;
        const auto role = role_in_braces(*of, effect_);
        if (role || *of == "period" || *of == "duration") s.of = role.value_or(*of);
        else file_.error(*t.get("of"), quoted(*of) + " is nothing that a range can be counted in", "write \"period\", \"duration\", or a {role} of [roles]");
    }

    void read_factor(const toml::table& t, EffectScan& s, bool range_known) {
        const auto factor = file_.number(t, "factor");
        if (t.contains("step")) file_.error(*t.get("step"), "'step' beside 'factor'", "leave one of the two out");
        if (!factor) return;
        s.step = 0;
        s.factor = exact::nearest(*factor, plan::Scalar::float64);
        if (!(s.factor >= 1.01)) file_.error(*t.get("factor"), "'factor' is below 1.01", "write a number such as 1.5");
        else if (range_known && !(s.from > 0)) file_.error(*t.get("from"), "'from' is not positive, and a factor leads nowhere from it", "write a number above 0");
        else if (range_known && !(s.from < s.to)) file_.error(*t.get("to"), "to is not above from", "swap them");
    }

    void read_range(const toml::table& t, EffectScan& s) {
        const auto number = [&](const char* key, double& out) {
            const auto value = file_.number(t, key);
            if (!t.contains(key)) file_.error(t, "no " + std::string(key) + " of the scanned number", "add from, to and step, or spectrum = true for a frequency");
            if (value) out = exact::nearest(*value, plan::Scalar::float64);
            return value.has_value();
        };
        const bool from = number("from", s.from);   // all three: each has its own complaint
        const bool to = number("to", s.to);
        if (t.contains("factor")) {
            read_factor(t, s, from && to);
            return;
        }
        if (!number("step", s.step)) return;
        if (!(s.step > 0)) {
            file_.error(*t.get("step"), "'step' is not positive", "write a number above 0");
        } else if (from && to && !(s.from < s.to)) {
            file_.error(*t.get("to"), "to is not above from", "swap them");
        } else if (from && to && (s.to - s.from) / s.step > most_scanned) {
            file_.error(*t.get("step"), "more than " + std::to_string(static_cast<int>(most_scanned)) + " values to scan", "choose a larger step or a shorter range");
        }
    }

    void read_rival(const toml::table& t) {
        file_.known_keys(t, {"name", "experiment", "first"});
        Rival r{needed(t, model::position(t), "name", "viscous_friction"), prose(t, model::position(t), "experiment", "run at several speeds"), file_.boolean(t, "first").value_or(false)};
        if (!r.name.empty()) {
            const Position at = model::position(*t.get("name"));
            check_effect_name(r.name, at);
            const bool again = std::any_of(effect_.rivals.begin(), effect_.rivals.end(), [&](const Rival& other) { return other.name == r.name; });
            if (again) file_.error(at, quoted(r.name) + " is a rival twice", "name each once");
            if (r.name == effect_.name) file_.error(at, quoted(r.name) + " is its own rival", "name another effect");
        }
        effect_.rivals.push_back(std::move(r));
    }

    void read_rewrite(const toml::table& t) {
        file_.known_keys(t, {"kind", "term", "d", "q"});
        if (!t.contains("kind")) file_.error(t, "no kind", "add kind = \"add_term\"");
        std::set<std::string> used;
        effect_.term = term(t, "term", placeholders_of(effect_), used);
        if (!t.contains("term")) file_.error(t, "no term", "add term = \"-Tc*sgn({speed})\"");
        if (t.contains("d") != t.contains("q")) file_.error(t, t.contains("d") ? "d without q" : "q without d", "write both terms of a rotating frame, or neither");
        effect_.d_term = term(t, "d", axes_of_a_frame(), used);
        effect_.q_term = term(t, "q", axes_of_a_frame(), used);
        say_unused(used);
    }

    /// What is declared and stands nowhere.
    void say_unused(const std::set<std::string>& used) {
        if (!file_.sound()) return;   // what a term that is wrong would have used is not known
        for (const auto& [name, at] : places_) if (used.count(name) == 0) file_.error(at, quoted(name) + " stands in no term", "use it, or remove it");
        for (const auto& [role, at] : role_places_) if (used.count("{" + role + "}") == 0) file_.error(at, "{" + role + "} stands in no term", "use it, or remove it");
    }

    void read_edits(const toml::table& root, const toml::table& rewrite) {
        file_.known_keys(rewrite, effect_.rewrite == Rewrite::free_constant ? std::vector<std::string>{"kind", "what"} : std::vector<std::string>{"kind"});
        EditReading reading{file_, effect_, names_known_, {}};
        reading.read(root, rewrite);
        if (!effect_.scans.empty() && effect_.roles.count(effect_.scans[0].of) > 0) reading.used.insert("{" + effect_.scans[0].of + "}");
        say_unused(reading.used);
    }

    std::string term(const toml::table& t, std::string_view key, const Placeholders& placeholders, std::set<std::string>& used) {
        const auto text = file_.string(t, key);
        if (!text) return "";
        if (text->empty()) file_.error(*t.get(key), quoted(key) + " is empty", "write what it adds to the driving side, with its sign");
        else if (names_known_) check_term(effect_, *text, placeholders, *t.get(key), file_, used);
        return *text;
    }

    TomlAccess& file_;
    Effect& effect_;
    bool in_a_frame_ = false;
    bool names_known_ = true;                        // else the terms are not looked at: one fault, one complaint
    std::map<std::string, std::string> names_;       // folded -> as declared
    std::map<std::string, Position> places_;         // of parameters and scanned numbers
    std::map<std::string, Position> role_places_;
};

}  // namespace

std::optional<Effect> read_effect(const std::string& path, Diagnostics& diagnostics) {
    const auto text = model::read_text(path, model::largest_file, diagnostics);
    if (!text) return std::nullopt;
    Effect effect;
    const bool sound = model::read_toml(path, *text, "see docs/discover.md", diagnostics, [&](const toml::table& root, TomlAccess& file) { Reading(file, effect).read(root); });
    return sound ? std::optional(std::move(effect)) : std::nullopt;
}

}  // namespace algest::lab
