// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/roles.hpp"

#include <algorithm>
#include <cctype>

namespace algest::lab {

namespace {

using units::Unit;

Unit unit_of(const model::Signal& signal) { return signal.unit.empty() ? Unit() : Unit::parse(signal.unit).value_or(Unit()); }

void find_highest(const formula::Formula& f, const model::Model& model, Moved& out) {
    if (f->kind == formula::Kind::call && f->name == "der") {
        const int order = f->arguments.size() > 1 ? cln::cl_I_to_int(cln::numerator(f->arguments[1]->value)) : 1;
        if (order > out.order) out = {model.signal_index(f->arguments[0]->name), order};
    }
    for (const formula::Formula& a : f->arguments) find_highest(a, model, out);
}

}  // namespace

bool fits(const Unit& unit, const std::string& wanted) {
    const auto w = Unit::parse(wanted);
    return w && unit.same_dimension(*w);
}

Moved moved(const model::Model& model, const model::Equation& e) {
    Moved out;
    find_highest(e.sides.left, model, out);
    find_highest(e.sides.right, model, out);
    return out;
}

int integral_of(const model::Model& model, int speed) {
    for (const model::Equation& e : model.equations) {
        const auto is_rate = [&](const formula::Formula& a, const formula::Formula& b) {
            return a->kind == formula::Kind::call && a->name == "der" && a->arguments.size() == 1 && b->kind == formula::Kind::name && model.signal_index(b->name) == speed;
        };
        if (is_rate(e.sides.left, e.sides.right)) return model.signal_index(e.sides.left->arguments[0]->name);
        if (is_rate(e.sides.right, e.sides.left)) return model.signal_index(e.sides.right->arguments[0]->name);
    }
    return -1;
}

std::string time_name(const model::Model& model) {
    for (const model::Signal& s : model.signals) if (s.column == time_column) return s.name;
    const auto taken = [&](const std::string& name) {
        const auto is = [&](const auto& x) { return x.name == name || (x.name.size() == 1 && name.size() == 1 && std::toupper(x.name[0]) == std::toupper(name[0])); };
        return std::any_of(model.signals.begin(), model.signals.end(), is) || std::any_of(model.constants.begin(), model.constants.end(), is) || std::any_of(model.parameters.begin(), model.parameters.end(), is);
    };
    for (const char* name : {"t", "time"}) if (!taken(name)) return name;
    return "recording_time";
}

const std::vector<RoleKind>& role_kinds() {
    static const std::vector<RoleKind> kinds = {{"own", {}}, {"speed", {"rad/s", "m/s"}}, {"position", {"rad", "m"}}, {"angle", {"rad"}}, {"current", {"A"}},
                                                {"any_speed", {"rad/s", "m/s"}}, {"input", {}}, {"time", {"s"}}};
    return kinds;
}

std::vector<Filler> fillers(const std::string& kind, const model::Model& model, std::size_t equation, const std::vector<bool>& measured) {
    const Moved own = moved(model, model.equations[equation]);
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
        const int x = is_position ? own.signal : is_speed ? integral_of(model, own.signal) : -1;
        if (x >= 0) {
            const model::Signal& position = model.signals[static_cast<std::size_t>(x)];
            if (kind == "position" || fits(unit_of(position), "rad")) out.push_back({position.name, position.unit.empty() ? "1" : position.unit});
        }
    }
    if (kind == "time") out.push_back({time_name(model), "s"});
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const Unit u = unit_of(model.signals[s]);
        const bool moves = std::any_of(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return moved(model, e).signal == static_cast<int>(s); });
        if (!measured[s]) continue;
        if (kind == "any_speed" && static_cast<int>(s) != own.signal && (fits(u, "rad/s") || fits(u, "m/s"))) out.push_back({model.signals[s].name, model.signals[s].unit});
        if (kind == "input" && !moves) out.push_back({model.signals[s].name, model.signals[s].unit.empty() ? "1" : model.signals[s].unit});
    }
    return out;
}

}  // namespace algest::lab
