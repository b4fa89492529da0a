// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/discrete_derivation.hpp"

#include <nlohmann/json.hpp>

#include "generator/discrete.hpp"
#include "generator/exact.hpp"
#include "generator/formula.hpp"
#include "generator/polynomial.hpp"
#include "generator/render.hpp"

#ifndef ALGEST_VERSION
#define ALGEST_VERSION "0"
#endif

namespace algest::generator {

namespace {

using exact::Rational;
using plan::Plan;

/// In one variable, from coefficients with the lowest power first.
Polynomial polynomial(const std::vector<std::string>& coefficients) {
    Polynomial out;
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
        if (coefficients[k] != "0") out.emplace(Exponents{static_cast<int>(k)}, exact::from_text(coefficients[k]));
    }
    return out;
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
    std::string out;
    for (const std::string& t : texts) out += (out.empty() ? "" : between) + t;
    return out;
}

const std::string& signal_of(const Plan& plan, bool input) {
    for (const plan::RowTerm& t : plan.rows.front().terms) {
        if (plan.discrete->combinations[static_cast<std::size_t>(t.lumped < 0 ? static_cast<int>(plan.lumped.size()) : t.lumped)].input == input) return plan.window_signals[static_cast<std::size_t>(t.signal)].text;
    }
    return plan.window_signals.front().text;
}

/// " + A2 q^2 + .. " from a first order on: "", " + A2 q^2", or with dots.
std::string further(const std::string& name, const std::string& variable, int from, int to) {
    const auto term = [&](int i) { return " + " + name + std::to_string(i) + " " + variable + (i == 1 ? "" : "^" + std::to_string(i)); };
    if (to < from) return "";
    return to == from ? term(from) : to == from + 1 ? term(from) + term(to) : term(from) + " + ..." + term(to);
}

/// d^nbar/dz^nbar z^i y_z as products of z and derivatives of y_z.
std::string expansion(int i, int derivatives) {
    std::vector<std::string> names = {"z"};
    for (int d = derivatives; d >= 0; --d) names.push_back("y_z^(" + std::to_string(d) + ")");
    Polynomial out;
    for (const discrete::LeibnizTerm& t : discrete::leibniz_expansion(i, derivatives)) {
        Exponents x(names.size(), 0);
        x[0] = t.power;
        x[static_cast<std::size_t>(derivatives - t.derivative) + 1] = 1;
        out = sum(out, Polynomial{{x, Rational(t.coefficient)}});
    }
    return text(out, names);
}

Data combinations_data(const Plan& plan) {
    DataList out;
    for (const plan::Combination& c : plan.discrete->combinations) {
        const Polynomial taps = polynomial(c.taps);
        const bool one = taps.size() == 1 && taps.begin()->second == 1;
        const std::string sum = latex(taps, {"z"});
        Data d;
        d.set("column", c.name);
        d.set("signal", signal_of(plan, c.input));
        d.set("scale", c.scale);
        d.set("taps", joined(c.taps, " "));
        d.set("column_tex", c.name == "known" ? std::string("\\text{known}") : formula::latex_name(c.name));
        d.set("combination_tex", exact::latex(exact::from_text(c.scale)) + "\\," + (one ? sum : "\\left(" + sum + "\\right)") + "\\, " + formula::latex_name(signal_of(plan, c.input)) + "(k-" + std::to_string(plan.discrete->n) + ")");
        out.push_back(d);
    }
    return listed(out);
}

Data common(const Plan& plan) {
    const plan::Discrete& s = *plan.discrete;
    const bool in_q = s.domain == plan::Domain::q;
    Data d;
    d.set("version", std::string(ALGEST_VERSION));
    d.set("name", plan.name);
    d.set("period", exact::decimal(exact::from_text(plan.period_text)));
    d.set("in_q", in_q);
    d.set("pooled", s.pooled);
    d.set("n", std::to_string(s.n));
    d.set("numerator", std::to_string(s.numerator));
    d.set("hidden", std::to_string(s.n - s.m));
    d.set("preset", std::to_string(s.m - s.numerator));
    d.set("derivatives", std::to_string(s.derivatives));
    d.set("zeros", s.derivatives > s.n ? "0, ..., " + std::to_string(s.n) : "1, ..., " + std::to_string(s.n) + " alone, not at 0, so that estimates are right from rest only");
    d.set("first_level", std::to_string(s.skip));
    d.set("last_level", std::to_string(s.n + s.numerator + s.skip + s.extra));
    d.set("unknown_count", std::to_string(plan.lumped.size()));
    d.set("intervals", std::to_string(plan.intervals));
    d.set("combinations", combinations_data(plan));
    return d;
}

}  // namespace

std::string discrete_derivation_text(const Plan& plan, const std::string& solve_text) {
    const plan::Discrete& s = *plan.discrete;
    const bool in_q = s.domain == plan::Domain::q;
    Data d = common(plan);
    d.set("summary", plan.summary);
    d.set("has_summary", !plan.summary.empty());
    d.set("source", plan.source);
    d.set("has_source", !plan.source.empty());
    d.set("window", exact::decimal(exact::from_text(plan.period_text) * plan.intervals));
    d.set("samples", std::to_string(plan.samples()));
    d.set("solve_text", solve_text);
    DataList notes;
    for (const std::string& n : plan.notes) {
        Data note;
        note.set("note", n);
        notes.push_back(note);
    }
    d.set("notes", listed(notes));
    d.set("ode", plan.equations.front().ode);
    d.set("more_a", in_q ? further("A", "q", 2, s.n) : further("a", "z", 1, s.n));
    d.set("more_b", in_q ? further("B", "q", 1, s.numerator) : further("b", "z", 1, s.numerator));
    DataList leibniz;
    for (int i = 0; i <= s.n && !s.pooled; ++i) {
        Data l;
        l.set("i", std::to_string(i));
        l.set("expansion", expansion(i, s.derivatives));
        leibniz.push_back(l);
    }
    d.set("leibniz", listed(leibniz));
    d.set("sign", std::string(s.derivatives % 2 == 0 ? "" : "-"));
    d.set("chi", text(polynomial(s.multiplier), {"k"}));
    const Rational gamma = exact::from_text(s.gamma);
    d.set("summing", gamma == 1 ? std::string("the sum over all earlier k") : "1/(z - " + exact::decimal(gamma) + ")");
    d.set("filtered", !s.filter_numerator.empty());
    d.set("filter_numerator", joined(s.filter_numerator, " "));
    d.set("filter_denominator", joined(s.filter_denominator, " "));
    DataList parameters;
    for (const plan::Parameter& p : plan.parameters) {
        Data i;
        i.set("parameter", p.name);
        i.set("unit", p.unit.empty() ? std::string("not declared") : p.unit);
        parameters.push_back(i);
    }
    d.set("parameters", listed(parameters));
    return render("report/discrete.md.mustache", d);
}

std::string discrete_derivation_latex(const Plan& plan) {
    const plan::Discrete& s = *plan.discrete;
    Data d = common(plan);
    std::string name_tex;
    for (const char c : plan.name) name_tex += c == '_' ? std::string("\\_") : std::string(1, c);
    d.set("name_tex", name_tex);
    d.set("chi_tex", latex(polynomial(s.multiplier), {"k"}));
    const Rational gamma = exact::from_text(s.gamma);
    d.set("forgetting", gamma != 1);
    d.set("gamma_tex", exact::latex(gamma));
    return render("report/discrete.tex.mustache", d);
}

std::string discrete_derivation_json(const Plan& plan, const std::string& solve_text, bool weights) {
    using Json = nlohmann::ordered_json;
    const plan::Discrete& s = *plan.discrete;
    const auto terms_of = [&](const plan::Row& row) {
        Json terms = Json::array();
        for (const plan::RowTerm& t : row.terms) {
            const std::size_t column = t.lumped < 0 ? plan.lumped.size() : static_cast<std::size_t>(t.lumped);
            Json term = {{"parameter", t.lumped < 0 ? Json(nullptr) : Json(plan.lumped[column].name)},
                         {"signal", plan.window_signals[static_cast<std::size_t>(t.signal)].text},
                         {"scale", s.combinations[column].scale},
                         {"taps", s.combinations[column].taps}};
            if (weights) {
                Json list = Json::array();
                for (const double w : plan.tables[static_cast<std::size_t>(t.table)].weights) list.push_back(exact::hexadecimal(w));
                term["factor"] = exact::hexadecimal(t.factor);
                term["weights"] = std::move(list);
            }
            terms.push_back(std::move(term));
        }
        return terms;
    };
    Json equation = {{"name", plan.equations.front().name}, {"n", s.n}, {"m", s.m}, {"numerator", s.numerator}, {"derivatives", s.derivatives}, {"chi", s.multiplier}, {"rows", Json::array()}};
    for (const plan::Row& row : plan.rows) equation["rows"].push_back({{"level", row.p}, {"terms", terms_of(row)}});
    Json out = {{"name", plan.name},
                {"window_s", exact::nearest(exact::from_text(plan.period_text) * plan.intervals, plan::Scalar::float64)},
                {"samples", plan.samples()},
                {"solve", solve_text},
                {"domain", s.domain == plan::Domain::q ? "q" : "z"},
                {"omega0", s.omega0},
                {"gamma", s.gamma},
                {"equations", Json::array({equation})},
                {"unknowns", Json::array()},
                {"parameters", Json::array()}};
    for (const plan::Lumped& u : plan.lumped) out["unknowns"].push_back({{"name", u.name}, {"meaning", u.meaning}});
    for (const plan::Parameter& p : plan.parameters) out["parameters"].push_back({{"name", p.name}, {"unit", p.unit}, {"from", p.from}});
    return out.dump(2) + "\n";
}

}  // namespace algest::generator
