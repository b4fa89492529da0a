// SPDX-License-Identifier: GPL-3.0-or-later
// [[equation]], [transfer], [[feedback]]: formulas whose names exist and whose dimensions fit.
#include <algorithm>

#include "generator/constant_value.hpp"
#include "generator/dimension.hpp"
#include "generator/model_keys.hpp"
#include "generator/model_sections.hpp"
#include "generator/names.hpp"
#include "generator/suggestion.hpp"
#include "generator/transfer.hpp"

namespace algest::model {

namespace {

using formula::Formula;

Position place_of(int offset, const std::vector<Position>& places) { return places[std::min(static_cast<std::size_t>(offset), places.size() - 1)]; }

formula::Complain complaint_at(const std::vector<Position>& places, TomlAccess& file) {
    return [&places, &file](int offset, const std::string& what, const std::string& right) { file.error(place_of(offset, places), what, right); };
}

bool unknown_name(const Formula& f, const std::vector<Position>& places, Reading& reading) {
    if (reading.refused_names.count(f->name) > 0) return false;   // said where it is declared
    std::vector<std::string> declared;
    for (const auto& [key, name] : reading.names) declared.push_back(name);
    reading.file.error(place_of(f->start, places), "unknown name '" + f->name + "'",
                       did_you_mean(f->name, declared) + "declare it under [signals], [constants] or [parameters]");
    return false;
}

/// delay() takes a signal and a time that is known or a parameter, never before now.
bool sound_delay(const Formula& f, const std::vector<Position>& places, Reading& reading) {
    const Model& model = reading.model;
    const auto complain = [&](std::size_t argument, const std::string& what, const std::string& right) {
        reading.file.error(place_of(f->arguments[argument]->start, places), what, right);
        return false;
    };
    if (f->arguments[0]->kind != formula::Kind::name || model.signal(f->arguments[0]->name) == nullptr) {
        return complain(0, "delay() of something that is not a signal", "write delay(x, 0.02) of a signal x; delay the signals of an expression one by one");
    }
    const Formula& by = f->arguments[1];
    if (by->kind == formula::Kind::name && model.parameter(by->name) != nullptr) {
        const auto& min = model.parameter(by->name)->min;
        if (min && *min >= 0) return true;
        return complain(1, "the delay '" + by->name + "' may become negative, which is the future", "give the parameter min = 0");
    }
    if (!check_constants(model, by, complaint_at(places, reading.file))) return false;
    const auto value = constant_value(model, by);
    if (!value) return complain(1, "the time of a delay is neither known nor a parameter", "write a number in s, a formula of constants, or a parameter alone");
    if (cln::minusp(*value)) return complain(1, "a delay by less than nothing", "a delay is 0 s or more");
    return true;
}

/// Every name is declared, der() takes a signal and a whole order. Complains about each that is not.
bool names_exist(const Formula& f, const std::vector<Position>& places, Reading& reading) {
    const Model& model = reading.model;
    if (f->kind == formula::Kind::name) {
        const bool declared = model.signal(f->name) != nullptr || model.constant(f->name) != nullptr || model.parameter(f->name) != nullptr;
        return declared || unknown_name(f, places, reading);
    }
    if (formula::is_derivative(f)) {
        const Formula& x = f->arguments[0];
        if (x->kind != formula::Kind::name || (model.signal(x->name) == nullptr && names_exist(x, places, reading))) {
            reading.file.error(place_of(x->start, places), "der() of something that is not a signal", "write der(x) of a signal x; expand products by hand");
            return false;
        }
        if (model.signal(x->name) == nullptr) return false;
        if (f->arguments.size() > 1) {
            const Formula& order = f->arguments[1];
            const bool whole_order = order->kind == formula::Kind::number && exact::is_integer(order->value) &&
                                     order->value >= 1 && order->value <= largest_order;
            if (!whole_order) {
                reading.file.error(place_of(order->start, places), "the order of der() is not a whole number from 1 to " + std::to_string(largest_order), "write der(x,2)");
                return false;
            }
        }
        return true;
    }
    bool good = true;
    for (const Formula& a : f->arguments) good = names_exist(a, places, reading) && good;
    if (good && formula::is_call(f, "delay")) return sound_delay(f, places, reading);
    return good;
}

/// Every name is declared, every part made of constants has a value.
bool sound(const Formula& f, const std::vector<Position>& places, Reading& reading) {
    return names_exist(f, places, reading) && check_constants(reading.model, f, complaint_at(places, reading.file));
}

RowChoice read_rows(const toml::table& t, TomlAccess& file) {
    RowChoice out;
    const toml::node* node = t.get("rows");
    if (node == nullptr) return out;
    out.at = position(*node);
    const toml::array* array = node->as_array();
    if (array == nullptr) {
        out.count = file.whole(t, "rows", 1, largest_row);
        return out;
    }
    for (const toml::node& entry : *array) {
        const auto p = entry.value_exact<std::int64_t>();
        if (!p || *p < 1 || *p > largest_row || std::count(out.list.begin(), out.list.end(), static_cast<int>(*p)) > 0) {
            file.error(entry, "rows lists p from 1 to " + std::to_string(largest_row) + ", each once", "e.g. rows = [2, 3]");
        } else {
            out.list.push_back(static_cast<int>(*p));
        }
    }
    if (array->empty()) file.error(*node, "rows is empty", "leave it out, or list some p");
    return out;
}

/// What [[equation]] and [transfer] have in common: which rows, of what weight.
/// The names under which the coefficients of a perturbation are given; each is a name like any other.
void read_perturbation(const toml::table& t, Equation& e, Reading& reading) {
    const auto name = reading.file.string(t, "perturbation");
    if (!name) return;
    const toml::node& node = *t.get("perturbation");
    e.perturbation_at = position(node);
    if (e.kappa == 0) {
        reading.file.error(node, "a perturbation is asked for, and kappa = 0 annihilates none", "write kappa = 1 for a constant one, 2 for a ramp");
        return;
    }
    for (int i = 1; i <= e.kappa; ++i) {
        const std::string one = e.kappa == 1 ? *name : *name + std::to_string(i);
        if (const auto fault = fault_of_name(one)) {
            reading.file.error(node, fault->what, fault->right);
            return;
        }
        const auto [place, fresh] = reading.names.emplace(folded(one), one);
        if (!fresh) {
            reading.file.error(node, quoted(one) + " is the name of a coefficient of this perturbation, and of something else: " + quoted(place->second), "choose another name");
            return;
        }
    }
    e.perturbation = *name;
}

void read_estimation(const toml::table& t, Equation& e, Reading& reading) {
    TomlAccess& file = reading.file;
    e.file = file.path();
    e.kappa = file.whole(t, "kappa", 0, largest_kappa).value_or(0);
    e.rows = read_rows(t, file);
    e.scale = file.positive(t, "scale");
    read_perturbation(t, e, reading);
    if (reading.model.estimator.has_window()) return;
    if (e.kappa > 0) file.error(*t.get("kappa"), "kappa is for annihilators, and this functional has none", "write the perturbation as a parameter of its own");
    if (e.rows.count.value_or(1) > 1 || e.rows.list.size() > 1) file.error(*t.get("rows"), "an equation has one row an instant with this functional", "leave rows out");
}

void read_equation(const toml::table& t, Reading& reading) {
    TomlAccess& file = reading.file;
    Model& model = reading.model;
    file.known_keys(t, key_names(Where::equation));
    Equation e;
    e.name = file.string(t, "name").value_or("equation " + std::to_string(model.equations.size() + 1));
    if (const auto fault = fault_of_prose(e.name)) file.error(*t.get("name"), fault->what, fault->right);
    for (const Equation& other : model.equations) {
        if (other.name == e.name && t.contains("name")) file.error(*t.get("name"), "two equations are named " + quoted(e.name), "rename one");
    }
    read_estimation(t, e, reading);
    const auto ode = file.string(t, "ode");
    if (!ode) {
        if (!t.contains("ode")) file.error(t, "an equation without ode", "add ode = \"L*der(i) = v - R*i\"");
        return;
    }
    e.ode = *ode;
    e.at = position(*t.get("ode"));
    e.places = file.places(*t.get("ode"), ode->size());
    const auto sides = formula::parse_equation(e.ode, complaint_at(e.places, file));
    if (!sides) return;
    e.sides = *sides;
    const bool left = sound(e.sides.left, e.places, reading);   // both: each has its own complaints
    const bool right = sound(e.sides.right, e.places, reading);
    if (!left || !right) return;
    check_dimension(model, e, file.diagnostics());
    model.equations.push_back(std::move(e));
}

/// True if every name in it is a measured signal or a constant. Complains about the first that is not, and about der().
bool of_measured_signals(const Formula& f, const std::vector<Position>& places, Reading& reading) {
    const auto refuse = [&](const std::string& what, const std::string& right) {
        reading.file.error(place_of(f->start, places), what, right);
        return false;
    };
    if (formula::is_derivative(f)) return refuse("der() in a computed signal", "differentiate the computed signal in the equation: der(NAME)");
    if (f->kind == formula::Kind::call && f->name == "delay") return refuse("delay() in a computed signal", "feed the delayed samples as a signal of their own");
    if (f->kind == formula::Kind::name) {
        const Signal* signal = reading.model.signal(f->name);
        if (reading.model.parameter(f->name) != nullptr) return refuse("a parameter in a computed signal", "write the product in the equation");
        if (signal != nullptr && !signal->formula_text.empty()) return refuse(quoted(f->name) + " is computed too", "write out its formula");
    }
    return std::all_of(f->arguments.begin(), f->arguments.end(), [&](const Formula& a) { return of_measured_signals(a, places, reading); });
}

void read_formula(Signal& signal, const toml::table& t, Reading& reading) {
    TomlAccess& file = reading.file;
    const toml::node& node = *t.get("formula");
    const std::vector<Position> places = file.places(node, signal.formula_text.size());
    for (const char* key : {"noise", "resolution", "column", "initial", "hold", "min", "max"}) {
        if (t.contains(key)) file.error(*t.get(key), std::string(key) + " beside formula", "say it of the signals that the formula is made of");
    }
    const auto formula = formula::parse(signal.formula_text, complaint_at(places, file));
    if (!formula || !sound(*formula, places, reading) || !of_measured_signals(*formula, places, reading)) return;
    signal.formula = *formula;
    Equation definition;   // signal = formula, for its dimension
    definition.file = file.path();
    definition.places = places;
    definition.sides.left = std::make_shared<const formula::Node>(formula::Node{formula::Kind::name, 0, 0, 0, signal.name, {}});
    definition.sides.right = *formula;
    check_dimension(reading.model, definition, file.diagnostics());
}

void read_law(const toml::table& t, Reading& reading) {
    TomlAccess& file = reading.file;
    Model& model = reading.model;
    file.known_keys(t, key_names(Where::feedback));
    Feedback f;
    f.at = position(t);
    const auto signal = file.string(t, "signal");
    const auto law = file.string(t, "law");
    if (!t.contains("signal") || !t.contains("law")) file.error(t, "[[feedback]] needs signal and law", "e.g. signal = \"u\", law = \"K*(r-y)\"");
    if (!signal || !law) return;
    f.signal = *signal;
    if (model.signal(f.signal) == nullptr) file.error(*t.get("signal"), quoted(f.signal) + " is not a signal", did_you_mean(f.signal, signal_names(model)) + "declare it under [signals]");
    for (const Feedback& other : model.feedback) {
        if (other.signal == f.signal) file.error(*t.get("signal"), "a second law for " + quoted(f.signal), "one law computes a signal");
    }
    f.law_text = *law;
    f.places = file.places(*t.get("law"), law->size());
    const auto formula = formula::parse(f.law_text, complaint_at(f.places, file));
    if (!formula || !sound(*formula, f.places, reading)) return;
    f.law = *formula;
    check_dimension(model, f, file.diagnostics());
    model.feedback.push_back(std::move(f));
}

void read_order(const toml::table& t, int n, TransferInput& input, TomlAccess& file) {
    input.m_at = t.contains("m") ? position(*t.get("m")) : position(t);
    input.m = file.whole(t, "m", 0, largest_order).value_or(0);
    if (input.m > n) {
        file.error(input.m_at, "m = " + std::to_string(input.m) + " is larger than n = " + std::to_string(n),
                   "the input may be differentiated at most as often as the output: m <= n");
    }
}

Coefficients read_coefficients(const toml::table& t, TomlAccess& file) {
    Coefficients out;
    for (PlacedText& name : file.strings(t, "unknowns", "[\"a0\", \"b0\"]")) out.unknowns.push_back({std::move(name.text), name.at});
    if (const toml::table* known = file.subtable(t, "known")) {
        file.each_named(*known, [&](const std::string& name, Position at, const toml::node& node) {
            if (const auto value = file.number(node, name)) out.known.push_back({name, at, *value});
        });
    }
    return out;
}

/// input = "u", or nothing said; n: m may not be above it.
TransferInput read_only_input(const toml::table& t, int n, TomlAccess& file) {
    TransferInput out;
    out.at = t.contains("input") ? position(*t.get("input")) : position(t);
    out.signal = file.string(t, "input").value_or("u");
    read_order(t, n, out, file);
    return out;
}

/// [[transfer.input]]
std::vector<TransferInput> read_inputs(const toml::table& t, int n, TomlAccess& file) {
    std::vector<TransferInput> out;
    if (t.get("input")->as_array()->empty()) file.error(*t.get("input"), "no input", "leave it out where the input is u, or name it");
    if (t.contains("m")) file.error(*t.get("m"), "m beside [[transfer.input]]", "give each input its own m");
    file.each_table(t, "input", [&](const toml::table& entry) {
        file.known_keys(entry, key_names(Where::transfer_input));
        TransferInput one;
        const auto signal = file.string(entry, "signal");
        if (!entry.contains("signal")) file.error(entry, "[[transfer.input]] without signal", "add signal = \"u\"");
        if (!signal) return;
        one.at = position(*entry.get("signal"));
        one.signal = *signal;
        read_order(entry, n, one, file);
        one.coefficients = read_coefficients(entry, file);
        out.push_back(one);
    });
    return out;
}

/// True if a coefficient is known and not 0: the equation's text shows it without the unit that it has.
bool knows_a_number(const Transfer& transfer) {
    const auto in = [](const Coefficients& c) {
        return std::any_of(c.known.begin(), c.known.end(), [](const KnownCoefficient& k) { return !cln::zerop(k.value); });
    };
    return in(transfer.coefficients) || std::any_of(transfer.inputs.begin(), transfer.inputs.end(), [&](const TransferInput& i) { return in(i.coefficients); });
}

void read_transfer(const toml::table& t, Reading& reading) {
    TomlAccess& file = reading.file;
    file.known_keys(t, key_names(Where::transfer));
    Transfer transfer;
    transfer.at = position(t);
    transfer.output = file.string(t, "output").value_or("y");
    transfer.output_at = t.contains("output") ? position(*t.get("output")) : transfer.at;
    const auto n = file.whole(t, "n", 1, largest_order);
    if (!t.contains("n")) file.error(t, "[transfer] without n", "add n, the order of the output's highest derivative");
    transfer.n = n.value_or(1);
    const int largest_m = n.value_or(largest_order);
    transfer.coefficients = read_coefficients(t, file);
    const bool several = t.contains("input") && t.get("input")->is_array();
    transfer.inputs = several ? read_inputs(t, largest_m, file) : std::vector<TransferInput>{read_only_input(t, largest_m, file)};
    Equation e;
    e.name = "transfer";
    e.at = transfer.at;
    read_estimation(t, e, reading);
    if (file.diagnostics().has_errors() || !write_out(transfer, reading.model, e, file.diagnostics())) return;
    if (!knows_a_number(transfer)) check_dimension(reading.model, e, file.diagnostics());
    reading.model.equations.push_back(std::move(e));
}

}  // namespace

void read_formulas(const toml::table& root, Reading& reading) {
    for (Signal& signal : reading.model.signals) {
        const toml::table* t = root.get("signals")->as_table()->get(signal.name)->as_table();
        if (t->contains("formula") && signal.formula_text.empty()) reading.file.error(*t->get("formula"), "an empty formula", "leave it out where the signal is measured");
        if (!signal.formula_text.empty()) read_formula(signal, *t, reading);
    }
}

void read_equations(const toml::table& root, Reading& reading) {
    TomlAccess& file = reading.file;
    const toml::node* equations = root.get("equation");
    if (equations != nullptr && root.contains("transfer")) {
        file.error(*equations, "both [transfer] and [[equation]]", "a model has one or the other");
    } else if (root.contains("transfer")) {
        if (const toml::table* t = file.subtable(root, "transfer")) read_transfer(*t, reading);
    } else if (equations == nullptr || (equations->is_array() && equations->as_array()->empty())) {
        if (!root.contains("discrete")) file.error(Position{1, 1}, "no equation", "add [transfer] or [[equation]]");
    } else {
        file.each_table(root, "equation", [&](const toml::table& table) { read_equation(table, reading); });
    }
}

void read_feedback(const toml::table& root, Reading& reading) {
    reading.file.each_table(root, "feedback", [&](const toml::table& table) { read_law(table, reading); });
}

}  // namespace algest::model
