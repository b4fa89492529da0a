// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/equation_unit.hpp"

#include <cmath>
#include <vector>

#include "generator/dimension.hpp"
#include "generator/tidy_unit.hpp"

namespace algest::model {

namespace {

using formula::Formula;
using formula::Kind;

void add_terms(const Formula& f, std::vector<Formula>& out) {
    if (f->kind != Kind::add && f->kind != Kind::subtract && f->kind != Kind::negate) return out.push_back(f);
    for (const Formula& a : f->arguments) add_terms(a, out);
}

std::string declared(const Model& model, const std::string& name) {
    if (const Signal* s = model.signal(name)) return s->unit;
    if (const Constant* c = model.constant(name)) return c->unit;
    if (const Parameter* p = model.parameter(name)) return p->unit;
    return "";
}

/// The units of the factors of a product; empty where one has none, or the term is no product of names, numbers and derivatives.
std::string of_term(const Model& model, const Formula& f) {
    if (f->kind == Kind::number) return "1";
    if (f->kind == Kind::name) return declared(model, f->name);
    if (formula::is_derivative(f)) {
        const std::string of = declared(model, f->arguments[0]->name);
        return of.empty() ? "" : "(" + of + ")/s^" + std::to_string(formula::derivative_order(f));
    }
    if (f->kind != Kind::multiply && f->kind != Kind::divide) return "";
    const std::string left = of_term(model, f->arguments[0]);
    const std::string right = of_term(model, f->arguments[1]);
    if (left.empty() || right.empty()) return "";
    return "(" + left + ")" + (f->kind == Kind::multiply ? "." : "/") + "(" + right + ")";
}

}  // namespace

std::string equation_unit(const Model& model, const Equation& equation) {
    const units::Unit unit = unit_of_equation(model, equation);
    std::vector<Formula> terms;
    add_terms(equation.sides.left, terms);
    add_terms(equation.sides.right, terms);
    std::string best;
    for (const Formula& term : terms) {
        const std::string spelling = units::tidy(of_term(model, term));
        const auto parsed = spelling.empty() ? std::nullopt : units::Unit::parse(spelling);
        // The same but for the rounding of UDUNITS' factors.
        if (!parsed || !parsed->same_dimension(unit) || std::abs(parsed->factor_to(unit) - 1) > 1e-9) continue;
        if (best.empty() || spelling.size() < best.size()) best = spelling;
    }
    return best.empty() ? unit.text() : best;
}

}  // namespace algest::model
