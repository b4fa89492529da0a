// SPDX-License-Identifier: GPL-3.0-or-later
// [signals], [constants], [parameters]: names, units, limits.
#include "generator/model_keys.hpp"
#include "generator/model_sections.hpp"
#include "generator/names.hpp"
#include "generator/units.hpp"

namespace algest::model {

using exact::Rational;

namespace {

/// Name, and the rules that signals, constants and parameters share.
bool take_name(const std::string& name, Position at, Reading& reading) {
    if (const auto fault = fault_of_name(name)) {
        reading.file.error(at, fault->what, fault->right);
        reading.refused_names.insert(name);
        return false;
    }
    const auto [place, fresh] = reading.names.emplace(folded(name), name);
    if (fresh) return true;
    if (place->second == name) reading.file.error(at, "'" + name + "' is declared twice", "give each its own name");
    else reading.file.error(at, "'" + name + "' and '" + place->second + "' differ by case alone", "rename one of them");
    return false;
}

std::string read_unit(const toml::table& t, const std::string& name, Position at, Reading& reading) {
    TomlAccess& file = reading.file;
    const auto text = file.string(t, "unit");
    if (!text) {
        if (!t.contains("unit")) {
            const std::string what = quoted(name) + " has no unit and goes unchecked";
            const std::string right = "add unit = \"...\", \"1\" if it has none";
            if (reading.strict) file.error(at, what, right);
            else file.warning(at, what, right);
        }
        return {};
    }
    const toml::node& node = *t.get("unit");
    if (const auto fault = units::fault_of_unit(*text)) {
        file.error(node, fault->what, fault->right);
        return {};
    }
    if (units::mentions_hertz(*text)) {
        file.warning(position(node), "Hz counts as rad/s: UDUNITS converts it with factor 1", "write rad/s, or 1/s");
    }
    return *text;
}

/// Accepts { key = value, ... }; anything else is one complaint.
const toml::table* entry(const std::string& name, const toml::node& node, Reading& reading) {
    if (!node.is_table()) reading.file.error(node, quoted(name) + " is not a table", "write NAME = { unit = \"...\" }");
    return node.as_table();
}

void check_limits(const toml::table& t, const std::optional<Rational>& min, const std::optional<Rational>& max, Reading& reading) {
    if (min && max && *min >= *max) reading.file.error(*t.get("max"), "max is not above min", "swap them");
}

void read_signal(const std::string& name, Position at, const toml::node& node, Reading& reading) {
    const toml::table* t = entry(name, node, reading);
    if (t == nullptr) return;
    TomlAccess& file = reading.file;
    file.known_keys(*t, key_names(Where::signal));
    const bool named = take_name(name, at, reading);
    Signal s;
    s.name = name;
    s.at = at;
    s.unit = read_unit(*t, name, at, reading);
    file.choose<plan::Hold>(*t, "hold", {{"linear", plan::Hold::linear}, {"zoh", plan::Hold::zoh}}, s.hold);
    s.column = file.string(*t, "column").value_or(name);
    s.noise = file.not_negative(*t, "noise");
    s.resolution = file.not_negative(*t, "resolution");
    s.initial = file.number(*t, "initial");
    s.min = file.number(*t, "min");
    s.max = file.number(*t, "max");
    s.scored = file.boolean(*t, "scored").value_or(true);
    s.formula_text = file.string(*t, "formula").value_or("");
    s.steady = file.positive(*t, "steady");
    s.lag = file.whole(*t, "lag", 0, largest_lag).value_or(0);
    check_limits(*t, s.min, s.max, reading);
    if (named) reading.model.signals.push_back(s);
}

void read_constant(const std::string& name, Position at, const toml::node& node, Reading& reading) {
    const toml::table* t = entry(name, node, reading);
    if (t == nullptr) return;
    TomlAccess& file = reading.file;
    file.known_keys(*t, key_names(Where::constant));
    const bool named = take_name(name, at, reading);
    const auto value = file.number(*t, "value");
    if (!t->contains("value")) file.error(at, "constant " + quoted(name) + " has no value", "write NAME = { value = 1, unit = \"1\" }");
    const std::string unit = read_unit(*t, name, at, reading);
    if (named) reading.model.constants.push_back({name, at, unit, value.value_or(1)});   // 1: keeps later complaints to the point
}

void read_parameter(const std::string& name, Position at, const toml::node& node, Reading& reading) {
    const toml::table* t = entry(name, node, reading);
    if (t == nullptr) return;
    TomlAccess& file = reading.file;
    file.known_keys(*t, key_names(Where::parameter));
    const bool named = take_name(name, at, reading);
    Parameter p;
    p.name = name;
    p.at = at;
    p.unit = read_unit(*t, name, at, reading);
    p.initial = file.number(*t, "initial");
    p.min = file.number(*t, "min");
    p.max = file.number(*t, "max");
    check_limits(*t, p.min, p.max, reading);
    if (p.initial && ((p.min && *p.initial < *p.min) || (p.max && *p.initial > *p.max))) {
        file.error(*t->get("initial"), "the initial value of " + quoted(name) + " is outside [min, max]", "choose one inside");
    }
    if (named) reading.model.parameters.push_back(p);
}

void each_of(const toml::table& root, std::string_view section, Reading& reading, void (*read)(const std::string&, Position, const toml::node&, Reading&)) {
    const toml::table* t = reading.file.subtable(root, section);
    if (t == nullptr) return;
    reading.file.each_named(*t, [&](const std::string& name, Position at, const toml::node& node) { read(name, at, node, reading); });
}

}  // namespace

void read_signals(const toml::table& root, Reading& reading) { each_of(root, "signals", reading, read_signal); }
void read_constants(const toml::table& root, Reading& reading) { each_of(root, "constants", reading, read_constant); }
void read_parameters(const toml::table& root, Reading& reading) { each_of(root, "parameters", reading, read_parameter); }

}  // namespace algest::model
