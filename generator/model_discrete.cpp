// SPDX-License-Identifier: GPL-3.0-or-later
// [discrete]: orders, which levels of sums, and the names that its unknowns take.
#include <algorithm>

#include "generator/model_keys.hpp"
#include "generator/model_sections.hpp"
#include "generator/names.hpp"
#include "generator/suggestion.hpp"

namespace algest::model {

namespace {

constexpr auto in_z = plan::Domain::z;

/// output = "y", input = "u", or the signals of these names.
std::string read_signal_name(const toml::table& t, const char* key, const char* otherwise, Reading& reading) {
    const std::string name = reading.file.string(t, key).value_or(otherwise);
    if (reading.model.signal(name) == nullptr) {
        const Position at = t.contains(key) ? position(*t.get(key)) : position(t);
        reading.file.error(at, quoted(name) + " is not a signal", did_you_mean(name, signal_names(reading.model)) + "declare it under [signals], or write " + key + " = \"...\"");
    }
    return name;
}

void read_orders(const toml::table& t, Discrete& d, TomlAccess& file) {
    d.n = file.whole(t, "n", 1, largest_order).value_or(1);
    if (!t.contains("n")) file.error(t, "[discrete] without n", "add n, the number of poles");
    d.m = file.whole(t, "m", 0, largest_order).value_or(std::max(0, d.n - 1));
    if (d.m > d.n) file.error(*t.get("m"), "m = " + std::to_string(d.m) + " is larger than n = " + std::to_string(d.n), "a transfer function has at most as many zeros as poles; one sampled behind a hold has m = n-1");
    d.numerator = file.whole(t, "numerator", 0, largest_order).value_or(d.m);
    if (d.numerator > d.m) file.error(*t.get("numerator"), "numerator = " + std::to_string(d.numerator) + " is larger than m = " + std::to_string(d.m), "choose at most m: the zeros above it are preset");
    d.derivatives = file.whole(t, "derivatives", 1, 2 * largest_order).value_or(d.n + 1);
    if (d.derivatives < d.n) {
        file.error(*t.get("derivatives"), "derivatives = " + std::to_string(d.derivatives) + " leave initial conditions in the rows", "choose n+1 = " + std::to_string(d.n + 1) + " or more");
    } else if (d.derivatives == d.n) {
        file.warning(position(*t.get("derivatives")), "derivatives = n leave the first sample's initial conditions in the rows: estimates are right from rest alone", "choose n+1 = " + std::to_string(d.n + 1) + " or more");
    }
}

std::vector<Rational> read_coefficients(const toml::table& t, const char* key, TomlAccess& file) {
    std::vector<Rational> out;
    const toml::array* list = t.get(key) == nullptr ? nullptr : t.get(key)->as_array();
    if (list == nullptr || list->empty() || list->size() > static_cast<std::size_t>(largest_order) + 1) {
        file.error(t.contains(key) ? position(*t.get(key)) : position(t), std::string(key) + " lists the coefficients in z^-1, the newest first, at most " + std::to_string(largest_order + 1),
                   "e.g. row_filter = { numerator = [0.1], denominator = [1, -0.9] }");
        return out;
    }
    for (const toml::node& entry : *list) {
        if (const auto c = file.number(entry, key)) out.push_back(*c);
    }
    return out;
}

void read_row_filter(const toml::table& t, Discrete& d, TomlAccess& file) {
    const toml::table* filter = file.subtable(t, "row_filter");
    if (filter == nullptr) return;
    file.known_keys(*filter, key_names(Where::row_filter));
    d.filter_numerator = read_coefficients(*filter, "numerator", file);
    d.filter_denominator = filter->contains("denominator") ? read_coefficients(*filter, "denominator", file) : std::vector<Rational>{1};
    if (!d.filter_denominator.empty() && cln::zerop(d.filter_denominator[0])) file.error(*filter->get("denominator"), "the filter's denominator begins with 0", "divide by a power of z: begin with what is not 0");
    if (std::all_of(d.filter_numerator.begin(), d.filter_numerator.end(), [](const Rational& c) { return cln::zerop(c); })) file.error(*filter, "the filter lets nothing through", "give it a numerator that is not 0");
}

/// Signals and constants that are called as an unknown would be.
void check_names(const Discrete& d, Reading& reading) {
    const auto taken = [&](const std::string& name) {
        const auto other = reading.names.find(folded(name));
        if (other != reading.names.end()) reading.file.error(d.at, quoted(name) + " is an unknown of [discrete], and " + quoted(other->second) + " something else", "rename " + quoted(other->second));
    };
    for (const std::string& name : unknown_names(d)) taken(name);
}

/// The window must hold more equations than the levels and their unknowns use up.
void check_length(const Discrete& d, Reading& reading) {
    const Model& model = reading.model;
    if (model.estimator.solve != Solver::square || !model.period || !model.window) return;
    const int needed = d.n + d.highest_level() + d.unknowns();
    const Rational intervals = *model.window / *model.period;
    if (intervals >= needed) return;
    reading.file.error(model.window_at, "the window is too short for " + std::to_string(d.highest_level()) + " levels of sums: each leaves out one sample more", "choose " + exact::decimal(*model.period * needed) + " s or more, or a smaller skip and extra");
}

/// What else is said beside [discrete] and does not go with it.
void check_company(const toml::table& root, const Discrete& d, Reading& reading) {
    TomlAccess& file = reading.file;
    const Model& model = reading.model;
    const Estimator& e = model.estimator;
    const Position estimator_at = e.given ? e.at : d.at;
    if (e.functional != Functional::discrete) file.error(estimator_at, "[discrete] without functional = \"discrete\"", "add functional = \"discrete\" under [estimator]");
    if (e.solve == Solver::elimination) file.error(e.at, "elimination with a discrete functional, whose unknowns are free of each other", "use solve = \"square\", or \"least_squares\" for the plain method");
    if (e.solve == Solver::robust) file.error(e.at, "a discrete functional has no S(t): its rows are those of one window", "use solve = \"square\", or \"least_squares\" for the plain method");
    if (e.whiten || e.limits_deviation() || e.uncertainty.value_or(false)) file.error(e.at, "whiten, deviation_limit and uncertainty are not to be had with a discrete functional", "leave them out");
    if (model.decimate > 1) file.error(model.sampling_at, "decimate with a discrete functional: means obey another difference equation", "sample less often, or leave it out");
    if (!model.parameters.empty()) file.error(model.parameters[0].at, "[parameters] beside [discrete], whose unknowns are " + unknown_names(d).front() + " to " + unknown_names(d).back(), "leave [parameters] out; known numbers of [[equation]] go under [constants]");
    if (root.contains("transfer")) file.error(*root.get("transfer"), "[transfer] beside [discrete]", "keep one; [[equation]] beside [discrete] serves simulation");
}

}  // namespace

std::vector<std::string> unknown_names(const Discrete& d) {
    std::vector<std::string> out;
    for (int i = 0; i < d.n; ++i) out.push_back(d.domain == in_z ? "a" + std::to_string(i) : "A" + std::to_string(i + 1));
    for (int i = 0; i <= d.numerator; ++i) out.push_back((d.domain == in_z ? "b" : "B") + std::to_string(i));
    return out;
}

void read_discrete(const toml::table& root, Reading& reading) {
    TomlAccess& file = reading.file;
    const toml::table* t = file.subtable(root, "discrete");
    if (t == nullptr) {
        if (reading.model.estimator.functional == Functional::discrete) file.error(reading.model.estimator.at, "functional = \"discrete\" without [discrete]", "add [discrete] with domain = \"q\" and n");
        return;
    }
    file.known_keys(*t, key_names(Where::discrete));
    Discrete d;
    d.at = position(*t);
    file.choose<plan::Domain>(*t, "domain", {{"z", plan::Domain::z}, {"q", plan::Domain::q}}, d.domain);
    if (!t->contains("domain")) file.error(*t, "[discrete] without domain", "add domain = \"q\", which stays well-conditioned when sampled fast, or \"z\"");
    d.output = read_signal_name(*t, "output", "y", reading);
    d.input = read_signal_name(*t, "input", "u", reading);
    if (d.output == d.input) file.error(*t, "output and input are one signal", "name two");
    read_orders(*t, d, file);
    d.skip = file.whole(*t, "skip", 0, largest_skip).value_or(0);
    d.extra = file.whole(*t, "extra", 0, most_extra_rows).value_or(0);
    if (const auto gamma = file.positive(*t, "gamma")) {
        if (*gamma > 1) file.error(*t->get("gamma"), "'gamma' is above 1", "1 gives sums, less a forgetting of old samples");
        else d.gamma = *gamma;
    }
    read_row_filter(*t, d, file);
    check_company(root, d, reading);
    check_names(d, reading);
    check_length(d, reading);
    reading.model.discrete = d;
}

}  // namespace algest::model
