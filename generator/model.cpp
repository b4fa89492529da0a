// SPDX-License-Identifier: GPL-3.0-or-later
// TOML -> Model: keys, types, ranges, names. Formulas go to `formula`, dimensions to `dimension`.
#include "generator/model.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "generator/constant_value.hpp"
#include "generator/dimension.hpp"
#include "generator/names.hpp"
#include "generator/source_text.hpp"
#include "generator/transfer.hpp"
#include "generator/units.hpp"

namespace algest::model {

namespace {

constexpr std::size_t largest_file = 1024 * 1024;
constexpr int longest_key = 10;           // dotted parts; a model needs 4
constexpr int most_complaints = 100;
constexpr std::size_t most_entries = 100;   // signals, constants, parameters, equations, each
constexpr std::size_t longest_unit = 60;
constexpr int largest_time = 9;           // 10^+-this, s

struct TooMany {};   // unwinds the reader after most_complaints

Position position(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}
Position position(const toml::node& node) { return position(node.source()); }

/// Letters to insert, remove, change or swap with the next to get from one word to the other.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

/// The key of `known` that is closest to a misspelt one, and all of them.
std::string suggestion(std::string_view key, const std::vector<std::string>& known) {
    std::string all;
    for (const std::string& k : known) all += (all.empty() ? "" : ", ") + k;
    if (key.size() > 40) return "keys here: " + all;
    const std::string* closest = nullptr;
    std::size_t least = std::max<std::size_t>(1, key.size() / 3) + 1;
    for (const std::string& k : known) {
        const bool one_begins_the_other = std::min(k.size(), key.size()) >= 3 && k.compare(0, key.size(), key, 0, k.size()) == 0;
        const std::size_t d = one_begins_the_other ? 1 : distance(key, k);
        if (d < least) {
            closest = &k;
            least = d;
        }
    }
    return (closest == nullptr ? "" : "did you mean " + *closest + "? ") + "keys here: " + all;
}

/// Reads one model file; holds what the readers of its parts share.
class Reader {
public:
    Reader(const std::string& path, const std::string& text, bool strict, Diagnostics& diagnostics)
        : path_(path), text_(text), strict_(strict), diagnostics_(diagnostics) {
        model_.path = path;
        model_.sampling_at = {1, 1};   // where there is no [sampling]
    }

    Model take() { return std::move(model_); }

    void read(const toml::table& root) {
        known_keys(root, {"format", "name", "summary", "source", "sampling", "signals", "constants", "parameters", "transfer",
                          "equation", "estimator", "feedback", "discrete"});
        read_head(root);
        if (const toml::table* t = subtable(root, "sampling")) read_sampling(*t);
        if (const toml::table* t = subtable(root, "signals")) each_named(*t, [&](auto& name, auto at, auto& node) { read_signal(name, at, node); });
        if (const toml::table* t = subtable(root, "constants")) each_named(*t, [&](auto& name, auto at, auto& node) { read_constant(name, at, node); });
        if (const toml::table* t = subtable(root, "parameters")) each_named(*t, [&](auto& name, auto at, auto& node) { read_parameter(name, at, node); });
        if (const toml::table* t = subtable(root, "estimator")) read_estimator(*t);
        if (const toml::node* d = root.get("discrete")) {
            error(*d, "[discrete] is not supported by this version", "use functional = \"annihilator\"");
        }
        if (root.contains("transfer") && root.contains("equation")) {
            error(*root.get("equation"), "both [transfer] and [[equation]]", "a model has one or the other");
        } else if (const toml::table* t = subtable(root, "transfer")) {
            read_transfer(*t);
        } else {
            each_table(root, "equation", [&](const toml::table& table) { read_equation(table); });
            const toml::array* equations = root["equation"].as_array();
            if ((!root.contains("equation") && !root.contains("transfer")) || (equations != nullptr && equations->empty())) {
                error(Position{1, 1}, "no equation", "add [transfer] or [[equation]]");
            }
        }
        each_table(root, "feedback", [&](const toml::table& table) { read_feedback(table); });
        if (model_.signals.empty() && !root.contains("signals")) {
            error(Position{1, 1}, "no [signals]", "declare what is measured: y = { unit = \"rad\" }");
        }
    }

private:
    // ---- complaints and typed access -------------------------------------------------------------------------------

    void error(Position at, std::string what, std::string right) {
        diagnostics_.error(path_, at, std::move(what), std::move(right));
        if (++complaints_ < most_complaints) return;
        diagnostics_.note(path_, "more than " + std::to_string(most_complaints) + " complaints: the rest is left out");
        throw TooMany{};
    }
    void error(const toml::node& node, std::string what, std::string right) { error(position(node), std::move(what), std::move(right)); }

    void known_keys(const toml::table& table, const std::vector<std::string>& known) {
        for (const auto& [key, node] : table) {
            if (std::find(known.begin(), known.end(), std::string(key.str())) == known.end()) {
                error(position(key.source()), "unknown key " + quoted(key.str()), suggestion(key.str(), known));
            }
        }
    }

    const toml::table* subtable(const toml::table& table, std::string_view key) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return nullptr;
        if (!node->is_table()) {
            error(*node, "'" + std::string(key) + "' is not a table", "write [" + std::string(key) + "]");
            return nullptr;
        }
        return node->as_table();
    }

    /// Tables in the order of the file: toml++ keeps them sorted by key.
    template <class Use>
    void each_named(const toml::table& table, Use use) {
        std::vector<std::pair<const toml::key*, const toml::node*>> entries;
        for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
        std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
            const auto x = a.first->source().begin;
            const auto y = b.first->source().begin;
            return x.line != y.line ? x.line < y.line : x.column < y.column;
        });
        std::size_t count = 0;
        for (const auto& [key, node] : entries) {
            if (!few_enough(position(key->source()), count++)) return;
            const std::string name(key->str());
            use(name, position(key->source()), *node);
        }
    }

    /// Too many entries are one complaint, and none of those beyond is looked at.
    bool few_enough(Position at, std::size_t count) {
        if (count < most_entries) return true;
        if (count == most_entries) error(at, "more than " + std::to_string(most_entries) + " entries here", "split the model");
        return false;
    }

    template <class Use>
    void each_table(const toml::table& root, std::string_view key, Use use) {
        const toml::node* node = root.get(key);
        if (node == nullptr) return;
        const toml::array* array = node->as_array();
        if (array == nullptr) {
            error(*node, "'" + std::string(key) + "' is not an array of tables", "write [[" + std::string(key) + "]]");
            return;
        }
        std::size_t count = 0;
        for (const toml::node& entry : *array) {
            if (!few_enough(position(entry), count++)) return;
            if (entry.is_table()) use(*entry.as_table());
            else error(entry, "'" + std::string(key) + "' holds something that is not a table", "write [[" + std::string(key) + "]]");
        }
    }

    std::optional<std::string> string(const toml::table& table, std::string_view key) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return std::nullopt;
        const auto value = node->value_exact<std::string>();
        if (!value) error(*node, "'" + std::string(key) + "' is not a text", "write it in quotes");
        return value;
    }

    std::optional<bool> boolean(const toml::table& table, std::string_view key) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return std::nullopt;
        const auto value = node->value_exact<bool>();
        if (!value) error(*node, "'" + std::string(key) + "' is neither true nor false", "write true or false");
        return value;
    }

    std::optional<Rational> number(const toml::node& node, const std::string& key) {
        const auto not_a_number = [&] {
            error(node, quoted(key) + " is not a number", "write a decimal or a fraction: 0.1, \"1/3\"");
            return std::nullopt;
        };
        std::optional<Rational> value;
        if (const auto integer = node.value_exact<std::int64_t>()) {
            value = Rational(cln::cl_I(static_cast<long>(*integer)));
        } else if (const auto real = node.value_exact<double>()) {
            if (!std::isfinite(*real)) {
                error(node, quoted(key) + " is not finite", "write a number");
                return std::nullopt;
            }
            value = exact::from_double(*real);
        } else if (const auto text = node.value_exact<std::string>()) {
            value = exact::parse(*text);
        }
        if (!value) return not_a_number();
        if (!within_power_of_ten(*value, largest_number)) {
            error(node, quoted(key) + " is beyond 1e" + std::to_string(largest_number) + " or closer to 0 than 1e-" + std::to_string(largest_number),
                  "choose units in which it is of usual size");
            return std::nullopt;
        }
        return value;
    }

    std::optional<Rational> number(const toml::table& table, std::string_view key) {
        const toml::node* node = table.get(key);
        return node == nullptr ? std::nullopt : number(*node, std::string(key));
    }

    std::optional<Rational> positive(const toml::table& table, std::string_view key) {
        const auto value = number(table, key);
        if (value && !cln::plusp(*value)) {
            error(*table.get(key), "'" + std::string(key) + "' is not positive", "write a number above 0");
            return std::nullopt;
        }
        return value;
    }

    /// A time in seconds, positive.
    std::optional<Rational> duration(const toml::table& table, std::string_view key) {
        const auto value = positive(table, key);
        if (value && !within_power_of_ten(*value, largest_time)) {
            const std::string limit = std::to_string(largest_time);
            error(*table.get(key), "'" + std::string(key) + "' is beyond 1e" + limit + " s or below 1e-" + limit + " s", "it is in seconds");
            return std::nullopt;
        }
        return value;
    }

    std::optional<int> whole(const toml::table& table, std::string_view key, int least, int most) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return std::nullopt;
        const auto value = node->value_exact<std::int64_t>();
        if (!value || *value < least || *value > most) {
            error(*node, "'" + std::string(key) + "' is not a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                  "write one, without a point");
            return std::nullopt;
        }
        return static_cast<int>(*value);
    }

    template <class Value>
    void choose(const toml::table& table, std::string_view key, const std::vector<std::pair<std::string, Value>>& choices, Value& out) {
        const auto text = string(table, key);
        if (!text) return;
        std::string all;
        for (const auto& [word, value] : choices) {
            if (word == *text) {
                out = value;
                return;
            }
            all += (all.empty() ? "" : " | ") + word;
        }
        error(*table.get(key), quoted(*text) + " is no " + std::string(key), std::string(key) + " is one of " + all);
    }

    // ---- parts of the file -----------------------------------------------------------------------------------------

    void read_head(const toml::table& root) {
        if (const toml::node* format = root.get("format")) {
            if (format->value_exact<std::int64_t>() != 1) error(*format, "format is not 1", "this version reads format = 1");
        }
        if (const auto name = string(root, "name")) {
            model_.name = *name;
            if (const auto fault = fault_of_model_name(*name)) error(*root.get("name"), fault->what, fault->right);
        } else if (!root.contains("name")) {
            error(Position{1, 1}, "no name", "add name = \"dc_motor\"");
        }
        for (const char* key : {"summary", "source"}) {
            if (const auto text = string(root, key)) {
                (key == std::string("summary") ? model_.summary : model_.source) = *text;
                if (const auto fault = fault_of_prose(*text)) error(*root.get(key), fault->what, fault->right);
            }
        }
    }

    void read_sampling(const toml::table& t) {
        known_keys(t, {"period", "window", "growing"});
        model_.sampling_at = position(t);
        model_.period = duration(t, "period");
        model_.window = duration(t, "window");
        if (t.contains("window")) model_.window_at = position(*t.get("window"));
        model_.growing = boolean(t, "growing").value_or(false);
        if (model_.growing) {
            error(*t.get("growing"), "a growing window is not supported by this version", "leave it out: the window then slides from the start");
        }
        if (model_.period && model_.window) check_window();
    }

    void check_window() {
        const Rational intervals = *model_.window / *model_.period;
        if (intervals > most_intervals) {
            error(model_.window_at, "the window has more than " + std::to_string(most_intervals) + " periods", "choose a shorter one, or sample less often");
        } else if (intervals < 2) {
            error(model_.window_at, "the window is shorter than two periods", "choose a longer one");
        } else if (!exact::is_integer(intervals)) {
            const exact::Integer below = cln::floor1(intervals);
            error(model_.window_at, "the window is not a whole number of periods: between " + exact::text(below) + " and " + exact::text(below + 1),
                  "e.g. window = \"" + exact::text(below * *model_.period) + "\", which is " + exact::text(below));
        } else {
            return;
        }
        model_.window.reset();
    }

    /// Name, and the rules that signals, constants and parameters share.
    bool take_name(const std::string& name, Position at) {
        if (const auto fault = fault_of_name(name)) {
            error(at, fault->what, fault->right);
            return false;
        }
        std::string folded = name;
        std::transform(folded.begin(), folded.end(), folded.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        const auto [place, fresh] = names_.emplace(folded, name);
        if (!fresh) {
            if (place->second == name) error(at, "'" + name + "' is declared twice", "give each its own name");
            else error(at, "'" + name + "' and '" + place->second + "' differ by case alone", "rename one of them");
            return false;
        }
        return true;
    }

    std::string unit(const toml::table& t, const std::string& name, Position at) {
        const auto text = string(t, "unit");
        if (!text) {
            if (!t.contains("unit")) {
                const std::string what = quoted(name) + " has no unit and goes unchecked";
                if (strict_) error(at, what, "add unit = \"...\", \"1\" if it has none");
                else diagnostics_.warning(path_, at, what, "add unit = \"...\", \"1\" if it has none");
            }
            return {};
        }
        const toml::node& node = *t.get("unit");
        if (const auto right = units::right_spelling(*text)) {
            error(node, quoted(*text) + " is not a unit", "write " + *right);
            return {};
        }
        if (fault_of_prose(*text) || text->size() > longest_unit || !units::Unit::parse(*text)) {
            error(node, "UDUNITS does not know the unit " + quoted(*text), "write products with points and powers with ^: N.m, kg.m^2, rad/s");
            return {};
        }
        if (units::mentions_hertz(*text)) {
            diagnostics_.warning(path_, position(node), "Hz counts as rad/s: UDUNITS converts it with factor 1", "write rad/s, or 1/s");
        }
        return *text;
    }

    /// Accepts { key = value, ... }; anything else is one complaint.
    const toml::table* entry(const std::string& name, const toml::node& node) {
        if (!node.is_table()) error(node, quoted(name) + " is not a table", "write NAME = { unit = \"...\" }");
        return node.as_table();
    }

    void read_signal(const std::string& name, Position at, const toml::node& node) {
        const toml::table* t = entry(name, node);
        if (t == nullptr) return;
        known_keys(*t, {"unit", "hold", "noise", "resolution", "column", "initial", "scored", "min", "max"});
        const bool named = take_name(name, at);
        Signal s;
        s.name = name;
        s.at = at;
        s.unit = unit(*t, name, at);
        choose<plan::Hold>(*t, "hold", {{"linear", plan::Hold::linear}, {"zoh", plan::Hold::zoh}}, s.hold);
        s.column = string(*t, "column").value_or(name);
        s.noise = not_negative(*t, "noise");
        s.resolution = not_negative(*t, "resolution");
        s.initial = number(*t, "initial");
        s.min = number(*t, "min");
        s.max = number(*t, "max");
        s.scored = boolean(*t, "scored").value_or(true);
        check_limits(*t, s.min, s.max);
        if (named) model_.signals.push_back(s);
    }

    std::optional<Rational> not_negative(const toml::table& t, std::string_view key) {
        const auto value = number(t, key);
        if (value && cln::minusp(*value)) {
            error(*t.get(key), "'" + std::string(key) + "' is negative", "write 0 or more");
            return std::nullopt;
        }
        return value;
    }

    void check_limits(const toml::table& t, const std::optional<Rational>& min, const std::optional<Rational>& max) {
        if (min && max && *min >= *max) error(*t.get("max"), "max is not above min", "swap them");
    }

    void read_constant(const std::string& name, Position at, const toml::node& node) {
        const toml::table* t = entry(name, node);
        if (t == nullptr) return;
        known_keys(*t, {"value", "unit"});
        const bool named = take_name(name, at);
        const auto value = number(*t, "value");
        if (!t->contains("value")) error(at, "constant " + quoted(name) + " has no value", "write NAME = { value = 1, unit = \"1\" }");
        const std::string declared = unit(*t, name, at);
        if (named && value) model_.constants.push_back({name, at, declared, *value});
        else if (named) model_.constants.push_back({name, at, declared, 1});   // keeps later complaints to the point
    }

    void read_parameter(const std::string& name, Position at, const toml::node& node) {
        const toml::table* t = entry(name, node);
        if (t == nullptr) return;
        known_keys(*t, {"unit", "initial", "min", "max"});
        const bool named = take_name(name, at);
        Parameter p;
        p.name = name;
        p.at = at;
        p.unit = unit(*t, name, at);
        p.initial = number(*t, "initial");
        p.min = number(*t, "min");
        p.max = number(*t, "max");
        check_limits(*t, p.min, p.max);
        if (p.initial && ((p.min && *p.initial < *p.min) || (p.max && *p.initial > *p.max))) {
            error(*t->get("initial"), "the initial value of " + quoted(name) + " is outside [min, max]", "choose one inside");
        }
        if (named) model_.parameters.push_back(p);
    }

    void read_estimator(const toml::table& t) {
        known_keys(t, {"functional", "form", "solve", "solve_window", "engine", "quadrature", "forgetting", "condition_limit"});
        Estimator& e = model_.estimator;
        e.given = true;
        e.at = position(t);
        choose<Functional>(t, "functional",
                           {{"annihilator", Functional::annihilator}, {"discrete", Functional::discrete},
                            {"derivative", Functional::derivative}, {"average", Functional::average}}, e.functional);
        choose<Solver>(t, "solve",
                       {{"square", Solver::square}, {"robust", Solver::robust}, {"least_squares", Solver::least_squares},
                        {"elimination", Solver::elimination}}, e.solve);
        choose<std::string>(t, "engine", {{"fir", "fir"}, {"moments", "moments"}}, e.engine);
        choose<plan::Quadrature>(t, "quadrature",
                                 {{"exact", plan::Quadrature::exact}, {"trapezoid", plan::Quadrature::trapezoid},
                                  {"simpson", plan::Quadrature::simpson}}, e.quadrature);
        e.form = whole(t, "form", 1, 2).value_or(1);
        e.solve_window = duration(t, "solve_window");
        e.condition_limit = positive(t, "condition_limit");
        if (const auto f = positive(t, "forgetting")) {
            if (*f > 1) error(*t.get("forgetting"), "'forgetting' is above 1", "1 keeps every row, 0.999 forgets slowly");
            else e.forgetting = *f;
        }
        if (e.functional != Functional::annihilator) {
            error(*t.get("functional"), "this functional is not supported by this version", "use functional = \"annihilator\"");
        }
        if (e.solve == Solver::elimination) {
            error(*t.get("solve"), "elimination is not supported by this version", "use square, robust or least_squares");
        }
        if (e.form == 2 && t.contains("form")) {
            error(*t.get("form"), "form 2 is not supported by this version", "use form = 1");
        }
        if (e.solve_window && model_.period && !exact::is_integer(*e.solve_window / *model_.period)) {
            error(*t.get("solve_window"), "solve_window is not a whole number of periods", "choose a multiple of the period");
        } else if (e.solve_window && model_.period && *e.solve_window / *model_.period > most_intervals) {
            error(*t.get("solve_window"), "solve_window has more than " + std::to_string(most_intervals) + " periods", "choose a shorter one");
        }
        if (e.quadrature == plan::Quadrature::simpson && model_.period && model_.window && cln::oddp(cln::numerator(*model_.window / *model_.period))) {
            error(*t.get("quadrature"), "Simpson's rule needs an even number of periods in the window", "change the window by one period");
        }
    }

    formula::Complain complaint_at(const std::vector<Position>& places) {
        return [this, &places](int offset, const std::string& what, const std::string& right) {
            error(places[std::min(static_cast<std::size_t>(offset), places.size() - 1)], what, right);
        };
    }

    RowChoice rows(const toml::table& t) {
        RowChoice out;
        const toml::node* node = t.get("rows");
        if (node == nullptr) return out;
        out.at = position(*node);
        if (const toml::array* array = node->as_array()) {
            for (const toml::node& entry : *array) {
                const auto p = entry.value_exact<std::int64_t>();
                if (!p || *p < 1 || *p > largest_row || std::count(out.list.begin(), out.list.end(), static_cast<int>(*p)) > 0) {
                    error(entry, "rows lists p from 1 to " + std::to_string(largest_row) + ", each once", "e.g. rows = [2, 3]");
                } else {
                    out.list.push_back(static_cast<int>(*p));
                }
            }
            if (array->empty()) error(*node, "rows is empty", "leave it out, or list some p");
        } else {
            out.count = whole(t, "rows", 1, largest_row);
        }
        return out;
    }

    void read_equation(const toml::table& t) {
        known_keys(t, {"name", "ode", "kappa", "rows", "scale"});
        Equation e;
        e.file = path_;
        e.name = string(t, "name").value_or("equation " + std::to_string(model_.equations.size() + 1));
        if (const auto fault = fault_of_prose(e.name)) error(*t.get("name"), fault->what, fault->right);
        for (const Equation& other : model_.equations) {
            if (other.name == e.name && t.contains("name")) error(*t.get("name"), "two equations are named " + quoted(e.name), "rename one");
        }
        e.kappa = whole(t, "kappa", 0, largest_kappa).value_or(0);
        e.rows = rows(t);
        e.scale = positive(t, "scale");
        const auto ode = string(t, "ode");
        if (!ode) {
            if (!t.contains("ode")) error(t, "an equation without ode", "add ode = \"L*der(i) = v - R*i\"");
            return;
        }
        e.ode = *ode;
        e.at = position(*t.get("ode"));
        e.places = places_of_string(text_, e.at, ode->size());
        const auto sides = formula::parse_equation(e.ode, complaint_at(e.places));
        if (!sides) return;
        e.sides = *sides;
        bool good = true;
        for (const formula::Formula& side : {e.sides.left, e.sides.right}) {
            good = names_exist(side, e.places) && check_constants(model_, side, complaint_at(e.places)) && good;
        }
        if (!good) return;
        check_dimension(model_, e, diagnostics_);
        model_.equations.push_back(std::move(e));
    }

    void read_feedback(const toml::table& t) {
        known_keys(t, {"signal", "law"});
        Feedback f;
        f.at = position(t);
        const auto signal = string(t, "signal");
        const auto law = string(t, "law");
        if (!t.contains("signal") || !t.contains("law")) error(t, "[[feedback]] needs signal and law", "e.g. signal = \"u\", law = \"K*(r-y)\"");
        if (!signal || !law) return;
        f.signal = *signal;
        if (model_.signal(f.signal) == nullptr) error(*t.get("signal"), quoted(f.signal) + " is not a signal", "declare it under [signals]");
        for (const Feedback& other : model_.feedback) {
            if (other.signal == f.signal) error(*t.get("signal"), "a second law for " + quoted(f.signal), "one law computes a signal");
        }
        f.law_text = *law;
        f.places = places_of_string(text_, position(*t.get("law")), law->size());
        const auto formula = formula::parse(f.law_text, complaint_at(f.places));
        if (!formula || !names_exist(*formula, f.places) || !check_constants(model_, *formula, complaint_at(f.places))) return;
        f.law = *formula;
        model_.feedback.push_back(std::move(f));
    }

    /// Every name is declared, der() takes a signal and a whole order. Complains about each that is not.
    bool names_exist(const formula::Formula& f, const std::vector<Position>& places) {
        const auto place = [&](const formula::Formula& g) { return places[std::min(static_cast<std::size_t>(g->start), places.size() - 1)]; };
        if (f->kind == formula::Kind::name) {
            if (model_.signal(f->name) != nullptr || model_.constant(f->name) != nullptr || model_.parameter(f->name) != nullptr) return true;
            std::string right = "declare it under [signals], [constants] or [parameters]";
            for (const auto& [folded, name] : names_) {
                std::string mine = f->name;
                std::transform(mine.begin(), mine.end(), mine.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
                if (folded == mine) right = "did you mean " + name + "?";
            }
            error(place(f), "unknown name '" + f->name + "'", right);
            return false;
        }
        bool good = true;
        if (f->kind == formula::Kind::call && f->name == "der") {
            const formula::Formula& x = f->arguments[0];
            if (x->kind != formula::Kind::name || (model_.signal(x->name) == nullptr && names_exist(x, places))) {
                error(place(x), "der() of something that is not a signal", "write der(x) of a signal x; expand products by hand");
                return false;
            }
            if (model_.signal(x->name) == nullptr) return false;
            if (f->arguments.size() > 1) {
                const formula::Formula& order = f->arguments[1];
                const bool whole_order = order->kind == formula::Kind::number && exact::is_integer(order->value) &&
                                         order->value >= 1 && order->value <= largest_order;
                if (!whole_order) {
                    error(place(order), "the order of der() is not a whole number from 1 to " + std::to_string(largest_order), "write der(x,2)");
                    return false;
                }
            }
            return true;
        }
        for (const formula::Formula& a : f->arguments) good = names_exist(a, places) && good;
        return good;
    }

    void read_transfer(const toml::table& t) {
        known_keys(t, {"output", "input", "n", "m", "kappa", "rows", "unknowns", "known", "scale"});
        Transfer transfer;
        transfer.at = position(t);
        transfer.output = string(t, "output").value_or("y");
        transfer.output_at = t.contains("output") ? position(*t.get("output")) : transfer.at;
        const auto n = whole(t, "n", 1, largest_order);
        if (!t.contains("n")) error(t, "[transfer] without n", "add n, the order of the output's highest derivative");
        transfer.n = n.value_or(1);
        const bool order_known = n.has_value();
        const toml::node* input = t.get("input");
        const bool several = input != nullptr && input->is_array();
        read_coefficients(t, transfer.coefficients);
        if (!several) {
            TransferInput single;
            single.at = input != nullptr ? position(*input) : transfer.at;
            single.signal = string(t, "input").value_or("u");
            read_order(t, order_known ? transfer.n : largest_order, single.m, single.m_at);
            transfer.inputs.push_back(single);
        } else {
            if (input->as_array()->empty()) error(*input, "no input", "leave it out where the input is u, or name it");
            if (t.contains("m")) error(*t.get("m"), "m beside [[transfer.input]]", "give each input its own m");
            each_table(t, "input", [&](const toml::table& entry) {
                known_keys(entry, {"signal", "m", "unknowns", "known"});
                TransferInput one;
                const auto signal = string(entry, "signal");
                if (!entry.contains("signal")) error(entry, "[[transfer.input]] without signal", "add signal = \"u\"");
                if (!signal) return;
                one.at = position(*entry.get("signal"));
                one.signal = *signal;
                read_order(entry, order_known ? transfer.n : largest_order, one.m, one.m_at);
                read_coefficients(entry, one.coefficients);
                transfer.inputs.push_back(one);
            });
        }
        Equation e;
        e.file = path_;
        e.name = "transfer";
        e.kappa = whole(t, "kappa", 0, largest_kappa).value_or(0);
        e.rows = rows(t);
        e.scale = positive(t, "scale");
        e.at = transfer.at;
        if (diagnostics_.has_errors()) return;
        if (write_out(transfer, model_, e, diagnostics_)) {
            if (!knows_a_number(transfer)) check_dimension(model_, e, diagnostics_);
            model_.equations.push_back(std::move(e));
        }
    }

    /// True if a coefficient is known and not 0: the equation's text shows it without the unit that it has.
    static bool knows_a_number(const Transfer& transfer) {
        const auto in = [](const Coefficients& c) {
            return std::any_of(c.known.begin(), c.known.end(), [](const KnownCoefficient& k) { return !cln::zerop(k.value); });
        };
        return in(transfer.coefficients) || std::any_of(transfer.inputs.begin(), transfer.inputs.end(), [&](const TransferInput& i) { return in(i.coefficients); });
    }

    void read_order(const toml::table& t, int n, int& m, Position& at) {
        at = t.contains("m") ? position(*t.get("m")) : position(t);
        m = whole(t, "m", 0, largest_order).value_or(0);
        if (m > n) {
            error(at, "m = " + std::to_string(m) + " is larger than n = " + std::to_string(n),
                  "the input may be differentiated at most as often as the output: m <= n");
        }
    }

    void read_coefficients(const toml::table& t, Coefficients& out) {
        if (const toml::node* node = t.get("unknowns")) {
            const toml::array* array = node->as_array();
            if (array == nullptr) error(*node, "'unknowns' is not a list", "write unknowns = [\"a0\", \"b0\"]");
            else for (const toml::node& entry : *array) {
                const auto name = entry.value_exact<std::string>();
                if (!name) error(entry, "an unknown is not a text", "write unknowns = [\"a0\", \"b0\"]");
                else out.unknowns.push_back({*name, position(entry)});
            }
        }
        if (const toml::table* known = subtable(t, "known")) {
            each_named(*known, [&](const std::string& name, Position at, const toml::node& node) {
                if (const auto value = number(node, name)) out.known.push_back({name, at, *value});
            });
        }
    }

    std::string path_;
    const std::string& text_;
    bool strict_;
    Diagnostics& diagnostics_;
    Model model_;
    std::map<std::string, std::string> names_;   // folded to lower case -> as declared
    int complaints_ = 0;
};

/// toml++ says it of a line end in a string as of any control character.
std::string toml_complaint(const toml::parse_error& e, const std::string& text, Position at) {
    std::string what(e.description());
    for (char& c : what) if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    if (what.find("control characters") != std::string::npos && at_line_end(text, at)) return "a text that is not closed on its line";
    return "not TOML: " + what;
}

}  // namespace

Position Equation::place(int offset) const {
    if (places.empty()) return at;
    return places[std::min(static_cast<std::size_t>(std::max(offset, 0)), places.size() - 1)];
}

const Signal* Model::signal(const std::string& wanted) const {
    for (const Signal& s : signals) if (s.name == wanted) return &s;
    return nullptr;
}
const Constant* Model::constant(const std::string& wanted) const {
    for (const Constant& c : constants) if (c.name == wanted) return &c;
    return nullptr;
}
const Parameter* Model::parameter(const std::string& wanted) const {
    for (const Parameter& p : parameters) if (p.name == wanted) return &p;
    return nullptr;
}
int Model::signal_index(const std::string& wanted) const {
    const Signal* s = signal(wanted);
    return s == nullptr ? -1 : static_cast<int>(s - signals.data());
}
int Model::parameter_index(const std::string& wanted) const {
    const Parameter* p = parameter(wanted);
    return p == nullptr ? -1 : static_cast<int>(p - parameters.data());
}

std::optional<Model> read(const std::string& path, bool strict, Diagnostics& diagnostics) {
    const auto text = read_text(path, largest_file, diagnostics);
    return text ? read_from_text(*text, path, strict, diagnostics) : std::nullopt;
}

std::optional<Model> read_from_text(const std::string& text, const std::string& path, bool strict, Diagnostics& diagnostics) {
    if (const auto at = not_utf8(text)) {
        diagnostics.error(path, *at, "not UTF-8", "save the file as UTF-8");
        return std::nullopt;
    }
    if (const auto at = too_long_key(text, longest_key)) {
        diagnostics.error(path, *at, "a key of more than " + std::to_string(longest_key) + " parts", "a model needs no such key");
        return std::nullopt;
    }
    try {
        const toml::table root = toml::parse(std::string_view(text), path);
        Reader reader(path, text, strict, diagnostics);
        reader.read(root);
        if (diagnostics.has_errors()) return std::nullopt;
        return reader.take();
    } catch (const TooMany&) {
        return std::nullopt;
    } catch (const toml::parse_error& e) {
        const Position at = within_line(text, position(e.source()));
        diagnostics.error(path, at, toml_complaint(e, text, at), "see the model file format in docs");
        return std::nullopt;
    }
}

}  // namespace algest::model
