// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/roles.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "lab/equation_places.hpp"
#include "lab/outputs.hpp"
#include "lab/rotating_frame.hpp"

namespace algest::lab {

namespace {

using units::Unit;

Unit unit_of(const model::Signal& signal) { return signal.unit.empty() ? Unit() : Unit::parse(signal.unit).value_or(Unit()); }

/// What a sensor shows without saying of what: in volts, or without a unit.
bool is_of_a_sensor(const Unit& unit) { return !unit.known() || fits(unit, "V"); }

void find_highest(const formula::Formula& f, const model::Model& model, Moved& out) {
    if (formula::is_derivative(f)) {
        const int order = formula::derivative_order(f);
        if (order > out.order) out = {model.signal_index(f->arguments[0]->name), order};
    }
    for (const formula::Formula& a : f->arguments) find_highest(a, model, out);
}

std::string unit_of_quantity(const model::Model& model, const std::string& name) {
    if (const model::Parameter* p = model.parameter(name)) return p->unit;
    if (const model::Constant* c = model.constant(name)) return c->unit;
    return "";
}

bool stands_in(const model::Equation& e, const std::string& name) { return !places_of_name(e, name).empty() || !places_of_derivative(e, name).empty(); }

/// Quantities that are counted or compared have no unit, and nobody is wrong about them.
bool may_be_wrong(const model::Constant& c) { return !c.unit.empty() && c.unit != "1" && !cln::zerop(c.value); }

/// What stands for the axes and quantities of the frame that an equation is the d equation of.
std::vector<Filler> fillers_of_frame(const std::string& kind, const model::Model& model, std::size_t equation, const std::vector<bool>& measured) {
    const auto frame = rotating_frame(model, measured);
    if (!frame || frame->d_equation != equation) return {};
    if (kind == "d_current") return {{frame->d_current, "A"}};
    if (kind == "q_current") return {{frame->q_current, "A"}};
    if (kind == "rotor_speed") return {{frame->speed, "rad/s"}};
    return {{frame->pairs, "1"}};
}

/// What stands for the quantities of an equation's own terms, and for the differences and constants in it.
std::vector<Filler> fillers_of_text(const std::string& kind, const model::Model& model, const model::Equation& e, const model::Signal& own) {
    std::vector<Filler> out;
    if (kind == "leading") {
        for (const Stretch& s : place_of_leading(model, e)) out.push_back({e.ode.substr(s.begin, s.end - s.begin), ""});
    } else if (kind == "factor") {
        for (const std::string& name : factors_of_signal(model, e, own.name)) out.push_back({name, ""});
    } else if (kind == "constant") {
        for (const model::Constant& c : model.constants) if (may_be_wrong(c) && stands_in(e, c.name)) out.push_back({c.name, ""});
    } else if (kind == "difference") {
        for (const auto& [a, b] : differences(model, e)) {
            const model::Signal& one = *model.signal(a);
            if (one.unit == model.signal(b)->unit && (fits(unit_of(one), "rad") || fits(unit_of(one), "m"))) out.push_back({"(" + a + "-" + b + ")", one.unit});
        }
    }
    for (Filler& f : out) if (f.unit.empty()) f.unit = unit_of_quantity(model, f.formula);
    return out;
}

/// In an equation that gives what a sensor shows of recorded signals nothing moves: every recorded signal of the right unit stands for itself.
std::vector<Filler> fillers_of_output(const std::string& kind, const model::Model& model, const model::Equation& e, const std::vector<bool>& measured) {
    static const std::map<std::string, std::vector<std::string>> units = {{"speed", {"rad/s", "m/s"}}, {"position", {"rad", "m"}}, {"angle", {"rad"}}, {"current", {"A"}}};
    if (kind == "time") return {{time_name(model), "s"}};
    const auto wanted = units.find(kind);
    if (wanted == units.end()) return kind == "constant" ? fillers_of_text(kind, model, e, {}) : std::vector<Filler>();
    std::vector<Filler> out;
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const model::Signal& signal = model.signals[s];
        const auto fitting = [&](const std::string& u) { return fits(unit_of(signal), u); };
        if (measured[s] && !is_output(model, static_cast<int>(s)) && std::any_of(wanted->second.begin(), wanted->second.end(), fitting)) out.push_back({signal.name, signal.unit});
    }
    return out;
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

std::string balanced(const model::Model& model, const model::Equation& e) {
    struct Motion {
        int order;
        const char* moved;
        const char* balanced;
    };
    static const Motion motions[] = {{1, "rad/s", "N.m"}, {2, "rad", "N.m"}, {1, "m/s", "N"}, {2, "m", "N"}, {1, "A", "V"}, {1, "K", "W"}};
    const Moved own = moved(model, e);
    if (own.signal < 0) return "";
    const Unit unit = unit_of(model.signals[static_cast<std::size_t>(own.signal)]);
    for (const Motion& m : motions) if (m.order == own.order && fits(unit, m.moved)) return m.balanced;
    return own.order == 2 && is_of_a_sensor(unit) ? "N" : "";
}

int integral_of(const model::Model& model, int speed) {
    for (const model::Equation& e : model.equations) {
        const auto is_rate = [&](const formula::Formula& a, const formula::Formula& b) {
            return formula::is_derivative(a) && formula::derivative_order(a) == 1 && b->kind == formula::Kind::name && model.signal_index(b->name) == speed;
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
                                                {"any_speed", {"rad/s", "m/s"}}, {"input", {}}, {"time", {"s"}},
                                                {"sensor", {}}, {"unsigned_sensor", {}}, {"actuator", {}}, {"drive", {"A", "N.m", "N"}}, {"leading", {}}, {"factor", {}}, {"dry_friction", {"N.m", "N"}}, {"difference", {"rad", "m"}}, {"constant", {}},
                                                {"d_current", {"A"}}, {"q_current", {"A"}}, {"rotor_speed", {"rad/s"}}, {"pole_pairs", {"1"}}};
    return kinds;
}

bool is_of_a_frame(const std::string& kind) { return kind == "d_current" || kind == "q_current" || kind == "rotor_speed" || kind == "pole_pairs"; }

std::vector<Filler> fillers(const std::string& kind, const model::Model& model, std::size_t equation, const std::vector<bool>& measured) {
    const Moved own = moved(model, model.equations[equation]);
    if (own.signal < 0) return output_of(model, model.equations[equation]) < 0 ? std::vector<Filler>() : fillers_of_output(kind, model, model.equations[equation], measured);
    const model::Signal& signal = model.signals[static_cast<std::size_t>(own.signal)];
    if (is_of_a_frame(kind)) return fillers_of_frame(kind, model, equation, measured);
    std::vector<Filler> out = fillers_of_text(kind, model, model.equations[equation], signal);
    const Unit unit = unit_of(signal);
    const bool is_speed = own.order == 1 && (fits(unit, "rad/s") || fits(unit, "m/s"));
    const bool is_position = own.order == 2 && (fits(unit, "rad") || fits(unit, "m") || is_of_a_sensor(unit));
    if ((kind == "sensor" || kind == "unsigned_sensor") && measured[static_cast<std::size_t>(own.signal)] && signal.scored) out.push_back({signal.name, signal.unit});
    if (kind == "own") out.push_back({signal.name, signal.unit});
    if (kind == "dry_friction" && (is_speed || is_position)) {
        for (const std::string& name : factors_of_sign(model, model.equations[equation], signal.name, is_position)) out.push_back({name, unit_of_quantity(model, name)});
    }
    if (kind == "current" && fits(unit, "A")) out.push_back({signal.name, signal.unit});
    if (kind == "speed") {
        if (is_speed) out.push_back({signal.name, signal.unit});
        if (is_position) out.push_back({"der(" + signal.name + ")", signal.unit.empty() ? "" : "(" + signal.unit + ")/s"});
    }
    if (kind == "angle" || kind == "position") {
        const int x = is_position ? own.signal : is_speed ? integral_of(model, own.signal) : -1;
        if (x >= 0) {
            const model::Signal& position = model.signals[static_cast<std::size_t>(x)];
            if (kind == "position" || fits(unit_of(position), "rad")) out.push_back({position.name, position.unit});
        }
    }
    if (kind == "time") out.push_back({time_name(model), "s"});
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const Unit u = unit_of(model.signals[s]);
        const bool moves = std::any_of(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return moved(model, e).signal == static_cast<int>(s); });
        if (!measured[s] || is_output(model, static_cast<int>(s))) continue;
        if (kind == "any_speed" && static_cast<int>(s) != own.signal && (fits(u, "rad/s") || fits(u, "m/s"))) out.push_back({model.signals[s].name, model.signals[s].unit});
        if (kind == "actuator" && !moves && model.signals[s].column != time_column && stands_in(model.equations[equation], model.signals[s].name)) out.push_back({model.signals[s].name, model.signals[s].unit});
        if (kind == "drive" && static_cast<int>(s) != own.signal && (fits(u, "A") || fits(u, "N.m") || fits(u, "N")) && stands_in(model.equations[equation], model.signals[s].name)) out.push_back({model.signals[s].name, model.signals[s].unit});
        if (kind == "input" && !moves) out.push_back({model.signals[s].name, model.signals[s].unit});
    }
    return out;
}

}  // namespace algest::lab
