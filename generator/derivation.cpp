// SPDX-License-Identifier: GPL-3.0-or-later
// The derivation of a plan: for the person who reviews a diff (Markdown), for a paper (LaTeX), for a program (JSON).
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "generator/annihilator.hpp"
#include "generator/discrete_derivation.hpp"
#include "generator/elimination_text.hpp"
#include "generator/exact.hpp"
#include "generator/formula.hpp"
#include "generator/generate.hpp"
#include "generator/kernel.hpp"
#include "generator/polynomial.hpp"
#include "generator/render.hpp"

#ifndef ALGEST_VERSION
#define ALGEST_VERSION "0"
#endif

namespace algest::generator {

namespace {

using exact::Rational;
using plan::Plan;

/// Lowest power first in the list; the printed polynomial has the highest first, as Polynomial orders it.
Polynomial in_sigma(const std::vector<std::string>& kernel) {
    Polynomial out;
    for (std::size_t k = 0; k < kernel.size(); ++k) {
        if (kernel[k] != "0") out.emplace(Exponents{static_cast<int>(k)}, exact::from_text(kernel[k]));
    }
    return out;
}

/// Joins signed products: (1, "a") and (-2, "b") give "a - 2 b".
class SignedSum {
public:
    SignedSum(std::string times, bool latex) : times_(std::move(times)), latex_(latex) {}
    void add(const Rational& coefficient, const std::string& factor) {
        const bool negative = cln::minusp(coefficient);
        const Rational size = cln::abs(coefficient);
        const std::string number = latex_ ? exact::latex(size) : exact::text(size);
        const std::string term = factor.empty() ? number : size == 1 ? factor : number + times_ + factor;
        out_ += out_.empty() ? (negative ? "-" + term : term) : (negative ? " - " : " + ") + term;
    }
    std::string text() const { return out_.empty() ? "0" : out_; }

private:
    std::string times_;
    bool latex_;
    std::string out_;
};

std::string power_text(const std::string& base, int power) { return power == 0 ? "" : power == 1 ? base : base + "^" + std::to_string(power); }

std::string expansion(const std::vector<plan::LeibnizTerm>& terms) {
    SignedSum sum(" ", false);
    for (const plan::LeibnizTerm& t : terms) {
        const std::string s = power_text("s", t.power);
        const std::string y = t.derivative_in_s == 0 ? "Y" : "Y^(" + std::to_string(t.derivative_in_s) + ")";
        sum.add(exact::from_text(t.coefficient), s.empty() ? y : s + " " + y);
    }
    return sum.text();
}

std::string expansion_tex(const std::vector<plan::LeibnizTerm>& terms) {
    SignedSum sum("\\,", true);
    for (const plan::LeibnizTerm& t : terms) {
        const std::string s = t.power == 0 ? "" : t.power == 1 ? "s\\," : "s^{" + std::to_string(t.power) + "}\\,";
        sum.add(exact::from_text(t.coefficient), s + (t.derivative_in_s == 0 ? "Y" : "Y^{(" + std::to_string(t.derivative_in_s) + ")}"));
    }
    return sum.text();
}

/// "1/2, 1/2"
std::string joined(const std::vector<double>& weights) {
    std::string out;
    for (const double w : weights) out += (out.empty() ? "" : ", ") + exact::text(exact::from_double(w));
    return out;
}

/// The kernel in time: sum of c (t-tau)^gamma (-tau)^j / gamma! after the division that makes it proper.
std::string time_form(const Plan& plan, const plan::Table& table) {
    if (plan.functional == plan::Functional::derivative) return "the weights " + joined(table.weights) + ", oldest sample first";
    for (const plan::Equation& e : plan.equations) {
        if (table.perturbation > 0) return "coefficient c_" + std::to_string(table.perturbation) + " of the perturbation, from rows with kappa = 0";
        if (e.n != table.n || e.kappa != table.kappa) continue;
        const auto of_row = std::find_if(e.annihilated.begin(), e.annihilated.end(), [&](const plan::Annihilated& a) { return a.p == 0 || a.p == table.p; });
        if (of_row == e.annihilated.end()) continue;
        SignedSum sum(" ", false);
        for (const plan::LeibnizTerm& t : of_row->leibniz[static_cast<std::size_t>(table.derivative)]) {
            const int gamma = annihilator::time_exponent(t.power, table.p, {table.n, table.kappa, table.form});
            const std::string first = power_text("(t-tau)", gamma);
            const std::string second = power_text("(-tau)", t.derivative_in_s);
            std::string factor = first + (first.empty() || second.empty() ? "" : " ") + second;
            if (gamma > 1) factor += "/" + std::to_string(gamma) + "!";
            sum.add(exact::from_text(t.coefficient), factor);
        }
        return "integral over [0,t] of f(tau) times  " + sum.text();
    }
    return "";
}

std::string solve_text(const Plan& plan) {
    switch (plan.solve) {
        case Solve::square:
            if (plan.rows.size() == plan.lumped.size()) return "square, the rows of one instant";
            return std::string("least squares of the rows of one instant") + (plan.whiten ? ", whitened with the covariance of their residuals at the last ok estimate" : "");
        case Solve::robust:
            return "robust, S(t) over " + std::to_string(plan.solve_instants) + " instants" +
                   (plan.ratio ? "; numerators and det S(t) through omega_n^2/(s^2 + 2 zeta omega_n s + omega_n^2), omega_n = " + exact::decimal(exact::from_text(plan.ratio->omega_n)) + " rad/s, zeta = " +
                                     exact::decimal(exact::from_text(plan.ratio->zeta))
                               : "");
        case Solve::least_squares: return plan.keep == 1.0 ? "least squares over all rows since reset" : "least squares over all rows since reset, with forgetting";
        case Solve::elimination: return std::string("least squares over all rows since reset under polynomial constraints, by elimination") + (plan.keep == 1.0 ? "" : ", with forgetting");
    }
    return "?";
}

/// "3", or "(3+p-1)" where each row differentiates once more.
std::string annihilator_order(const plan::Equation& e) {
    const std::string order = std::to_string(e.n + e.kappa);
    return e.form == 1 ? order : "(" + order + "+p-1)";
}

std::string annihilator_text(const plan::Equation& e) {
    const std::string order = annihilator_order(e);
    const std::string s = e.kappa == 0 ? "" : e.kappa == 1 ? " s" : " s^" + std::to_string(e.kappa);
    return "Pi = d^" + order + "/ds^" + order + s;
}

/// A power of s in front of something; nothing where it is 1.
std::string power_tex(int power) { return power == 0 ? "" : power == 1 ? "s\\, " : "s^{" + std::to_string(power) + "}\\, "; }

std::string annihilator_tex(const plan::Equation& e) {
    const std::string order = annihilator_order(e);
    const std::string d = order == "1" ? "\\frac{d}{ds}" : "\\frac{d^{" + order + "}}{ds^{" + order + "}}";
    return d + (e.kappa == 0 ? "" : e.kappa == 1 ? "\\, s" : "\\, s^{" + std::to_string(e.kappa) + "}");
}

Rational window(const Plan& plan) { return plan.steady ? exact::from_text(plan.period_text) * plan.steady->block : exact::from_text(plan.period_text) * plan.decimate * plan.intervals; }

Data common(const Plan& plan) {
    Data d;
    d.set("version", std::string(ALGEST_VERSION));
    d.set("name", plan.name);
    d.set("window", exact::decimal(window(plan)));
    d.set("annihilates", plan.functional == plan::Functional::annihilator);
    d.set("differentiates", plan.functional == plan::Functional::derivative);
    d.set("averages", plan.steady.has_value());
    d.set("held", plan.functional == plan::Functional::derivative && plan.intervals > 0);
    const bool second = !plan.equations.empty() && plan.equations.front().form == 2;
    d.set("division", std::string(second ? "differentiates p-1 times more than row 1 and divides by s^(kappa+n+1)" : "divides by s^(kappa+n+p)"));
    d.set("division_tex", std::string(second ? "differentiates $p-1$ times more than row 1 and is divided by $s^{\\kappa+n+1}$" : "is divided by $s^{\\kappa+n+p}$"));
    return d;
}

/// The names of the perturbation's coefficients, by its rows.
std::string perturbation_name(const Plan& plan, std::size_t row) { return plan.parameters[static_cast<std::size_t>(plan.estimated()) + row].name; }

std::string signal_of(const Plan& plan, const plan::RowTerm& term) { return term.signal < 0 ? "1" : plan.window_signals[static_cast<std::size_t>(term.signal)].text; }

Data equations_data(const Plan& plan) {
    DataList equations;
    for (const plan::Equation& e : plan.equations) {
        Data q;
        q.set("equation_name", e.name);
        q.set("ode", e.ode);
        const auto sides = formula::parse_equation(e.ode, [](int, const std::string&, const std::string&) {});
        q.set("ode_tex", sides ? formula::latex(sides->left) + " = " + formula::latex(sides->right) : e.ode);
        q.set("n", std::to_string(e.n));
        q.set("kappa", std::to_string(e.kappa));
        q.set("annihilator_tex", annihilator_tex(e));
        q.set("way", e.divided ? "Divided by the leading coefficient " + e.leading + "." : std::string("Used as written: it is linear in the unknowns."));
        q.set("late", e.delayed && plan.functional == plan::Functional::annihilator);
        q.set("annihilator", annihilator_text(e));
        q.set("perturbation", e.kappa == 0 ? std::string("") : e.kappa == 1 ? std::string(" and a constant perturbation") : " and a polynomial perturbation of degree " + std::to_string(e.kappa - 1));
        DataList operators;
        for (const plan::OperatorTerm& t : e.operators) {
            Data o;
            o.set("coefficient", t.parameter);
            o.set("signal", t.signal);
            o.set("derivative", std::to_string(t.derivative));
            operators.push_back(o);
        }
        q.set("operators", listed(operators));
        DataList leibniz;
        for (const plan::Annihilated& a : e.annihilated) {
            for (std::size_t i = 0; i < a.leibniz.size(); ++i) {
                Data l;
                l.set("i", std::to_string(i) + (a.p == 0 ? "" : ", p = " + std::to_string(a.p)));
                l.set("pi_tex", a.p == 0 ? std::string("\\Pi") : "\\Pi_{" + std::to_string(a.p) + "}");
                l.set("power_tex", power_tex(static_cast<int>(i)));
                l.set("expansion", expansion(a.leibniz[i]));
                l.set("expansion_tex", expansion_tex(a.leibniz[i]));
                leibniz.push_back(l);
            }
        }
        q.set("leibniz", listed(leibniz));
        equations.push_back(q);
    }
    return listed(equations);
}

/// LaTeX of a text in our own canonical spelling, e.g. "R/L" or "Gamma2/Gamma1".
std::string tex_of(const std::string& text) {
    const auto f = formula::parse(text, [](int, const std::string&, const std::string&) {});
    return f ? formula::latex(*f) : text;
}

Data unknowns_data(const Plan& plan) {
    DataList unknowns;
    for (const plan::Lumped& u : plan.lumped) {
        Data d;
        d.set("unknown", u.name);
        d.set("meaning", u.meaning);
        d.set("unknown_tex", formula::latex_name(u.name));
        d.set("meaning_tex", tex_of(u.meaning));
        unknowns.push_back(d);
    }
    return listed(unknowns);
}

Data parameters_data(const Plan& plan) {
    DataList parameters;
    for (const plan::Parameter& p : plan.parameters) {
        if (p.perturbation) continue;   // its rows are shown
        Data d;
        d.set("parameter", p.name);
        d.set("unit", p.unit.empty() ? std::string("not declared") : p.unit);
        d.set("from", p.from);
        d.set("parameter_tex", formula::latex_name(p.name));
        d.set("from_tex", tex_of(p.from));
        parameters.push_back(d);
    }
    return listed(parameters);
}

/// One kernel has a table for each hold; where a reader cannot see the tables' names, `once` leaves out what would be said again.
Data kernels_data(const Plan& plan, bool once) {
    DataList kernels;
    std::set<std::tuple<int, int, int, int, int, std::vector<std::string>>> said;
    for (const plan::Table& t : plan.tables) {
        if (once && !said.emplace(t.derivative, t.p, t.perturbation, t.n, t.kappa, t.kernel).second) continue;
        Data d;
        d.set("kernel_name", t.name);
        d.set("time_form", time_form(plan, t));
        d.set("polynomial", text(in_sigma(t.kernel), {"sigma"}));
        d.set("polynomial_tex", latex(in_sigma(t.kernel), {"sigma"}));
        d.set("derivative", std::to_string(t.derivative));
        d.set("p", t.perturbation > 0 ? "c_{" + std::to_string(t.perturbation) + "}" : std::to_string(t.p));
        d.set("kernel_n", std::to_string(t.n));
        d.set("kernel_kappa", std::to_string(t.kappa));
        kernels.push_back(d);
    }
    return listed(kernels);
}

/// Rows as tables of terms; those of a perturbation have a name instead of p.
Data rows_data(const Plan& plan, const std::vector<plan::Row>& of) {
    DataList rows;
    for (std::size_t r = 0; r < of.size(); ++r) {
        const plan::Row& row = of[r];
        Data q;
        q.set("row", std::to_string(r + 1));
        q.set("row_equation", plan.equations[static_cast<std::size_t>(row.equation)].name);
        q.set("p", std::to_string(row.p));
        q.set("coefficient_name", row.p > 0 ? std::string() : perturbation_name(plan, r));
        DataList terms;
        for (const plan::RowTerm& t : row.terms) {
            Data w;
            w.set("side", t.lumped < 0 ? std::string("known") : plan.lumped[static_cast<std::size_t>(t.lumped)].name);
            w.set("c", t.coefficient);
            w.set("f", signal_of(plan, t));
            w.set("order", std::to_string(t.derivative));
            w.set("k", t.table < 0 ? std::string("constant") : plan.tables[static_cast<std::size_t>(t.table)].name);
            terms.push_back(w);
        }
        q.set("terms", listed(terms));
        rows.push_back(q);
    }
    return listed(rows);
}

}  // namespace

std::string derivation_text(const Plan& plan) {
    if (plan.discrete) return discrete_derivation_text(plan, solve_text(plan));
    Data d = common(plan);
    d.set("summary", plan.summary);
    d.set("has_summary", !plan.summary.empty());
    d.set("source", plan.source);
    d.set("has_source", !plan.source.empty());
    d.set("period", exact::decimal(exact::from_text(plan.period_text)));
    d.set("intervals", std::to_string(plan.intervals));
    d.set("means", plan.decimate == 1 ? std::string() : " of means over " + std::to_string(plan.decimate) + " periods");
    d.set("samples", std::to_string(plan.samples()));
    d.set("solve_text", solve_text(plan));
    DataList notes;
    for (const std::string& n : plan.notes) {
        Data note;
        note.set("note", n);
        notes.push_back(note);
    }
    d.set("notes", listed(notes));
    d.set("equations", equations_data(plan));
    d.set("unknowns", unknowns_data(plan));
    d.set("parameters", parameters_data(plan));
    d.set("rows", rows_data(plan, plan.rows));
    d.set("perturbations", rows_data(plan, plan.perturbation));
    d.set("has_perturbation", !plan.perturbation.empty());
    DataList noise;
    for (const plan::NoiseChannel& c : plan.noise) {
        Data n;
        n.set("from", plan.tape_input(c.input));
        n.set("into", plan.window_signals[static_cast<std::size_t>(c.signal)].text);
        n.set("size", c.partial < 0 ? fmt::format("{:.6g}", std::abs(c.factor)) : fmt::format("{:.6g} times d({})/d({})", c.factor, plan.window_signals[static_cast<std::size_t>(c.signal)].text, plan.tape_input(c.input)));
        noise.push_back(n);
    }
    d.set("noise", listed(noise));
    d.set("uncertain", plan.uncertain());
    d.set("noisy", !plan.noise.empty());
    d.set("above_noise", plan.margin_over_noise > 0.0);
    d.set("points_above_noise", plan.points_above_noise());
    d.set("margin", fmt::format("{:.6g}", plan.margin_over_noise));
    d.set("kernels", kernels_data(plan, false));
    DataList stages;
    for (const std::string& text : elimination_stages(plan)) {
        Data stage;
        stage.set("stage", text);
        stages.push_back(stage);
    }
    d.set("stages", listed(stages));
    d.set("eliminates", plan.elimination.has_value());
    d.set("block", std::to_string(plan.steady ? plan.steady->block : 0));
    return render("report/derivation.md.mustache", d);
}

namespace {

/// A term's signal under the functional of its row.
std::string functional_tex(const Plan& plan, const plan::Row& row, const plan::RowTerm& t) {
    const std::string signal = tex_of(signal_of(plan, t));
    if (plan.functional == plan::Functional::derivative) return t.signal >= 0 && plan.window_signals[static_cast<std::size_t>(t.signal)].held ? "\\overline{" + signal + "}" : signal;
    return "F_{" + std::to_string(t.derivative) + "," + std::to_string(row.p) + "}\\left[" + signal + "\\right]";
}

}  // namespace

std::string derivation_latex(const Plan& plan) {
    if (plan.discrete) return discrete_derivation_latex(plan);
    Data d = common(plan);
    std::string name_tex;
    for (const char c : plan.name) name_tex += c == '_' ? std::string("\\_") : std::string(1, c);
    d.set("name_tex", name_tex);
    d.set("has_perturbation", !plan.perturbation.empty());
    d.set("equations", equations_data(plan));
    d.set("unknowns", unknowns_data(plan));
    d.set("parameters", parameters_data(plan));
    DataList rows;
    for (const plan::Row& row : plan.rows) {
        SignedSum unknown_side("\\,", true);
        SignedSum known_side("\\,", true);
        for (const plan::RowTerm& t : row.terms) {
            const std::string functional = functional_tex(plan, row, t);
            if (t.lumped < 0) known_side.add(exact::from_text(t.coefficient), functional);
            else unknown_side.add(exact::from_text(t.coefficient), formula::latex_name(plan.lumped[static_cast<std::size_t>(t.lumped)].name) + "\\," + functional);
        }
        Data q;
        q.set("unknown_side", unknown_side.text());
        q.set("known_side", known_side.text());
        rows.push_back(q);
    }
    for (std::size_t r = 0; r < plan.perturbation.size(); ++r) {
        const plan::Row& row = plan.perturbation[r];
        SignedSum all("\\,", true);
        int coefficient = 1;
        for (const plan::RowTerm& t : row.terms) {
            if (t.table >= 0) coefficient = plan.tables[static_cast<std::size_t>(t.table)].perturbation;
            const std::string functional = "C_{" + std::to_string(t.derivative) + "," + std::to_string(coefficient) + "}\\left[" + tex_of(signal_of(plan, t)) + "\\right]";
            const Rational c = exact::from_text(t.coefficient);
            if (t.lumped < 0) all.add(-c, functional);
            else all.add(c, formula::latex_name(plan.lumped[static_cast<std::size_t>(t.lumped)].name) + "\\," + functional);
        }
        const plan::Equation& equation = plan.equations[static_cast<std::size_t>(row.equation)];
        Data q;
        q.set("unknown_side", formula::latex_name(perturbation_name(plan, r)) + (equation.divided ? " / (" + tex_of(equation.leading) + ")" : ""));
        q.set("known_side", (coefficient > 1 ? "T^{-" + std::to_string(coefficient - 1) + "}\\left(" : "") + all.text() + (coefficient > 1 ? "\\right)" : ""));
        rows.push_back(q);
    }
    d.set("rows", listed(rows));
    d.set("kernels", kernels_data(plan, true));
    return render("report/derivation.tex.mustache", d);
}

namespace {

/// Those of the table times the term's coefficient where no interval is integrated over: differences of samples, means of steady states.
std::vector<double> weights_of(const Plan& plan, const plan::RowTerm& t) {
    if (t.kernel.empty() || plan.intervals == 0) {
        const Rational c = exact::from_text(t.coefficient);
        std::vector<double> out;
        if (t.table < 0) return {exact::nearest(c, plan.scalar)};
        for (const double w : plan.tables[static_cast<std::size_t>(t.table)].weights) out.push_back(exact::nearest(c * exact::from_double(w), plan.scalar));
        return out;
    }
    const plan::Hold hold = t.signal < 0 ? plan::Hold::linear : plan.window_signals[static_cast<std::size_t>(t.signal)].hold;
    return kernel::weights(kernel::coefficients(t.kernel), plan.intervals, hold, plan.quadrature, plan.scalar);
}

}  // namespace

std::string derivation_json(const Plan& plan, bool weights) {
    if (plan.discrete) return discrete_derivation_json(plan, solve_text(plan), weights);
    using Json = nlohmann::ordered_json;
    Json out;
    out["name"] = plan.name;
    out["window_s"] = exact::nearest(window(plan), plan::Scalar::float64);
    out["samples"] = plan.samples();
    out["decimate"] = plan.decimate;
    out["solve"] = solve_text(plan);
    out["equations"] = Json::array();
    for (std::size_t e = 0; e < plan.equations.size(); ++e) {
        const plan::Equation& equation = plan.equations[e];
        Json q;
        q["name"] = equation.name;
        q["n"] = equation.n;
        q["kappa"] = equation.kappa;
        q["form"] = equation.form;
        q["divided_by"] = equation.divided ? Json(equation.leading) : Json(nullptr);
        const auto terms_of = [&](const plan::Row& row) {
            Json terms = Json::array();
            for (const plan::RowTerm& t : row.terms) {
                Json term;
                term["parameter"] = t.lumped < 0 ? Json(nullptr) : Json(plan.lumped[static_cast<std::size_t>(t.lumped)].name);
                term["signal"] = signal_of(plan, t);
                term["derivative"] = t.derivative;
                term["kernel"] = t.kernel;
                if (weights) {
                    Json list = Json::array();
                    for (const double w : weights_of(plan, t)) list.push_back(exact::hexadecimal(w));
                    term["weights"] = std::move(list);
                }
                terms.push_back(std::move(term));
            }
            return terms;
        };
        q["rows"] = Json::array();
        for (const plan::Row& row : plan.rows) {
            if (row.equation == static_cast<int>(e)) q["rows"].push_back({{"p", row.p}, {"terms", terms_of(row)}});
        }
        q["perturbation"] = Json::array();
        for (std::size_t r = 0; r < plan.perturbation.size(); ++r) {
            const plan::Row& row = plan.perturbation[r];
            if (row.equation == static_cast<int>(e)) q["perturbation"].push_back({{"name", perturbation_name(plan, r)}, {"unit", plan.parameters[static_cast<std::size_t>(plan.estimated()) + r].unit}, {"terms", terms_of(row)}});
        }
        out["equations"].push_back(std::move(q));
    }
    out["unknowns"] = Json::array();
    for (const plan::Lumped& u : plan.lumped) out["unknowns"].push_back({{"name", u.name}, {"meaning", u.meaning}});
    out["parameters"] = Json::array();
    for (const plan::Parameter& p : plan.parameters) {
        if (!p.perturbation) out["parameters"].push_back({{"name", p.name}, {"unit", p.unit}, {"from", p.from}});
    }
    return out.dump(2) + "\n";
}

}  // namespace algest::generator
