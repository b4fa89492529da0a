// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/equation.hpp"

#include <ginac/ginac.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "generator/constant_value.hpp"
#include "generator/ginac_exact.hpp"
#include "generator/normal_form.hpp"

namespace algest::equation {

namespace {

using exact::Rational;
using formula::Formula;
using formula::Kind;
using GiNaC::ex;

struct Stop {};   // unwinds after a complaint

/// What a subformula is made of.
struct Contents {
    bool signals = false;
    bool parameters = false;
    bool derivative = false;
    std::vector<int> which;   // signals, in order of appearance
};

class Builder {
public:
    Builder(const model::Model& model, const model::Equation& equation, Diagnostics& diagnostics)
        : model_(model), equation_(equation), diagnostics_(diagnostics), normal_forms_(model) {
        for (const model::Parameter& p : model.parameters) parameters_.emplace_back(p.name);
    }

    OperatorForm build() {
        for (const Formula& side : {equation_.sides.left, equation_.sides.right}) {
            if (expanded_terms(side).most() > most_terms) {
                fail(side, "multiplied out, the equation has more than " + std::to_string(static_cast<int>(most_terms)) + " terms", "write it with fewer sums under powers");
            }
        }
        const ex left = of(equation_.sides.left);
        const ex right = of(equation_.sides.right);
        const ex total = without_denominators((left - right).expand());
        std::map<Product, Polynomial> sorted;
        if (GiNaC::is_a<GiNaC::add>(total)) {
            for (const ex& term : total) collect(term, sorted);
        } else if (!total.is_zero()) {
            collect(total, sorted);
        }
        OperatorForm out;
        out.atoms = atoms_;
        out.n = 0;
        out.leading = -1;
        out.delayed = false;
        for (auto& [product, coefficient] : sorted) {
            if (!coefficient.empty()) out.terms.push_back({coefficient, product});
        }
        std::sort(out.terms.begin(), out.terms.end(), [](const Term& a, const Term& b) { return a.product < b.product; });
        for (std::size_t k = 0; k < out.terms.size(); ++k) {
            const Product& product = out.terms[k].product;
            const bool alone = product.size() == 1 && product[0].power == 1 && atoms_[static_cast<std::size_t>(product[0].atom)].kind != Atom::Kind::function;
            const int order = out.order(product);
            if (alone && (out.leading < 0 || order > out.n)) {
                out.n = order;
                out.leading = static_cast<int>(k);
            }
            if (!alone) check_derivatives(product, out.delayed);
        }
        return out;
    }

private:
    [[noreturn]] void fail(const Formula& at, const std::string& what, const std::string& right) {
        diagnostics_.error(equation_.file, equation_.place(at->start), what, right);
        throw Stop{};
    }

    static constexpr double most_terms = 2000;

    /// How many terms numerator and denominator of a formula have once it is multiplied out over a common denominator, at most.
    /// What is below a signal stays one factor.
    struct Terms {
        double above;
        double below;
        double most() const { return std::max(above, below); }
    };

    static double of_power(double terms, int exponent) {
        double out = 1;
        for (int k = 1; k <= exponent; ++k) out = out * (terms + k - 1) / k;
        return out;
    }

    Terms expanded_terms(const Formula& f) const {
        if (rational_value(f)) return {1, 1};
        switch (f->kind) {
            case Kind::add:
            case Kind::subtract: {
                const Terms a = expanded_terms(f->arguments[0]);
                const Terms b = expanded_terms(f->arguments[1]);
                return {a.above * b.below + b.above * a.below, a.below * b.below};
            }
            case Kind::multiply: {
                const Terms a = expanded_terms(f->arguments[0]);
                const Terms b = expanded_terms(f->arguments[1]);
                return {a.above * b.above, a.below * b.below};
            }
            case Kind::negate: return expanded_terms(f->arguments[0]);
            case Kind::divide: {
                const Terms a = expanded_terms(f->arguments[0]);
                if (contents(f->arguments[1]).signals) return a;
                const Terms b = expanded_terms(f->arguments[1]);
                return {a.above * b.below, a.below * b.above};
            }
            case Kind::power: {
                const Terms a = expanded_terms(f->arguments[0]);
                const auto exponent = rational_value(f->arguments[1]);
                if (!exponent || !exact::is_integer(*exponent) || cln::abs(*exponent) > formula::largest_exponent) return {1, 1};   // a function of its own
                const int e = cln::cl_I_to_int(cln::numerator(*exponent));
                if (e >= 0) return {of_power(a.above, e), of_power(a.below, e)};
                if (contents(f->arguments[0]).signals) return {1, 1};
                return {of_power(a.below, -e), of_power(a.above, -e)};
            }
            default: return {1, 1};
        }
    }

    Contents contents(const Formula& f) const {
        Contents out;
        add_contents(f, out);
        return out;
    }
    void add_contents(const Formula& f, Contents& out) const {
        if (f->kind == Kind::name) {
            const int signal = model_.signal_index(f->name);
            out.signals = out.signals || signal >= 0;
            out.parameters = out.parameters || model_.parameter(f->name) != nullptr;
            if (signal >= 0 && std::find(out.which.begin(), out.which.end(), signal) == out.which.end()) out.which.push_back(signal);
        }
        out.derivative = out.derivative || (formula::is_derivative(f));
        for (const Formula& a : f->arguments) add_contents(a, out);
    }

    const Formula& first_parameter(const Formula& f) const {
        if (f->kind == Kind::name && model_.parameter(f->name) != nullptr) return f;
        for (const Formula& a : f->arguments) if (contents(a).parameters) return first_parameter(a);
        return f;
    }

    [[noreturn]] void nonlinear(const Formula& inside, const std::string& where) const {
        const Formula& p = first_parameter(inside);
        throw NonlinearParameter{p->name, where, equation_.place(p->start)};
    }

    /// The symbol of an atom, or of 1/atom. What has one normal form is one atom, a multiple of it a multiple of its symbol.
    ex symbol(const Atom& atom, bool reciprocal) {
        const NormalForm form = normal_forms_.of(atom.formula);
        if (cln::zerop(form.factor)) {
            if (reciprocal) fail(atom.formula, "division by zero", "remove the term");
            return 0;
        }
        std::size_t index = 0;
        while (index < atoms_.size() && (atoms_[index].kind != atom.kind || forms_[index].number != form.number)) ++index;
        if (index == atoms_.size()) {
            atoms_.push_back(atom);
            forms_.push_back(form);
            symbols_.emplace_back("x" + std::to_string(atoms_.size()));
            reciprocals_.emplace_back("r" + std::to_string(atoms_.size()));
        }
        const ex multiple = to_ginac(form.factor / forms_[index].factor);
        return reciprocal ? ex(reciprocals_[index] / multiple) : ex(multiple * symbols_[index]);
    }

    /// 1 or -1 where declared limits of signals, beyond which an estimator rejects a sample, leave a formula no other sign; else 0.
    int sign_within_limits(const Formula& f) const {
        if (const auto value = rational_value(f)) return cln::plusp(*value) ? 1 : cln::minusp(*value) ? -1 : 0;
        switch (f->kind) {
            case Kind::name: {
                const model::Signal* s = model_.signal(f->name);
                if (s == nullptr) return 0;
                return s->min && cln::plusp(*s->min) ? 1 : s->max && cln::minusp(*s->max) ? -1 : 0;
            }
            case Kind::negate: return -sign_within_limits(f->arguments[0]);
            case Kind::multiply:
            case Kind::divide: return sign_within_limits(f->arguments[0]) * sign_within_limits(f->arguments[1]);
            default: return 0;
        }
    }

    ex function_atom(const Formula& f, bool reciprocal) {
        if (formula::is_call(f, "sgn")) {
            if (const int sign = sign_within_limits(f->arguments[0]); sign != 0) return sign;   // friction of one sign is a constant
        }
        const Contents inside = contents(f);
        if (inside.parameters) nonlinear(f, f->kind == Kind::call ? "inside " + f->name + "()" : "inside a nonlinearity");
        check_orders(f);
        return symbol({Atom::Kind::function, -1, 0, f, formula::text(f), inside.which, inside.derivative}, reciprocal);
    }

    void check_orders(const Formula& f) {
        if (formula::is_derivative(f)) {
            if (formula::derivative_order(f) > 1) {
                fail(f, "a derivative of order above 1 inside a nonlinearity", "measure it, or write the equation without it");
            }
            return;
        }
        for (const Formula& a : f->arguments) check_orders(a);
    }

    /// A derivative in a product: only the parabola filter can give it, and only of order 1.
    void check_derivatives(const Product& product, bool& delayed) {
        for (const Factor& factor : product) {
            const Atom& atom = atoms_[static_cast<std::size_t>(factor.atom)];
            delayed = delayed || atom.differentiates || atom.kind == Atom::Kind::derivative;
            if (atom.kind == Atom::Kind::derivative && atom.order > 1) {
                fail(atom.formula, "a derivative of order above 1 inside a product of signals", "measure it, or write the equation without it");
            }
        }
    }

    /// A formula of numbers and constants: its value, functions and roots to 60 digits.
    std::optional<Rational> rational_value(const Formula& f) const { return model::constant_value(model_, f); }

    ex of(const Formula& f) {
        if (const auto value = rational_value(f)) return to_ginac(*value);
        switch (f->kind) {
            case Kind::number: break;   // has a value
            case Kind::name: {
                const int parameter = model_.parameter_index(f->name);
                if (parameter >= 0) return parameters_[static_cast<std::size_t>(parameter)];
                const int signal = model_.signal_index(f->name);
                return symbol({Atom::Kind::signal, signal, 0, f, f->name, {signal}, false}, false);
            }
            case Kind::negate: return -of(f->arguments[0]);
            case Kind::add:
            case Kind::subtract:
            case Kind::multiply:
            case Kind::divide: {
                const ex left = of(f->arguments[0]);   // first: atoms are numbered in the order of the text
                if (f->kind == Kind::divide) return left * reciprocal(f->arguments[1], 1);
                const ex right = of(f->arguments[1]);
                return f->kind == Kind::add ? left + right : f->kind == Kind::subtract ? left - right : left * right;
            }
            case Kind::power: return power(f);
            case Kind::call: return call(f);
        }
        throw std::logic_error("a number without a value");
    }

    ex call(const Formula& f) {
        if (f->name != "der") return function_atom(f, false);
        const int order = formula::derivative_order(f);
        const int signal = model_.signal_index(f->arguments[0]->name);
        const std::string name = f->arguments[0]->name;
        const std::string spelling = order == 1 ? "der(" + name + ")" : "der(" + name + "," + std::to_string(order) + ")";
        return symbol({Atom::Kind::derivative, signal, order, f, spelling, {signal}, false}, false);
    }

    ex power(const Formula& f) {
        const Formula& base = f->arguments[0];
        const auto exponent = rational_value(f->arguments[1]);
        if (contents(f->arguments[1]).parameters) nonlinear(f->arguments[1], "in an exponent");
        if (!exponent || !exact::is_integer(*exponent)) {
            if (contents(base).parameters) nonlinear(base, "under a power that is not a whole number");
            return function_atom(f, false);
        }
        if (cln::abs(*exponent) > formula::largest_exponent) fail(f->arguments[1], "the exponent is beyond " + std::to_string(formula::largest_exponent), "a model needs no such power");
        const int e = cln::cl_I_to_int(cln::numerator(*exponent));
        if (e < 0) return reciprocal(base, -e);
        if (e == 0) return 1;
        return GiNaC::pow(of(base), e);
    }

    /// 1 / f^power: a parameter goes into a common denominator, a signal expression becomes a factor of its own.
    ex reciprocal(const Formula& f, int power) {
        if (const auto value = rational_value(f)) {
            if (cln::zerop(*value)) fail(f, "division by zero", "remove the term");
            return to_ginac(exact::power(*value, -power));
        }
        const Contents inside = contents(f);
        if (!inside.signals) {
            if (!inside.parameters) return GiNaC::pow(function_atom(f, true), power);   // a function of constants
            const ex below = of(f).expand();
            if (below.is_zero()) fail(f, "division by zero", "remove the term");
            return GiNaC::pow(below, -power);
        }
        switch (f->kind) {
            case Kind::negate: return (power % 2 == 0 ? 1 : -1) * reciprocal(f->arguments[0], power);
            case Kind::multiply:
            case Kind::divide: {
                const ex left = reciprocal(f->arguments[0], power);
                if (f->kind == Kind::divide) return left * GiNaC::pow(of(f->arguments[1]), power);
                const ex right = reciprocal(f->arguments[1], power);
                return left * right;
            }
            case Kind::power: {
                const auto e = rational_value(f->arguments[1]);
                if (e && exact::is_integer(*e) && cln::plusp(*e) && cln::numerator(*e) * power <= formula::largest_exponent) {
                    return reciprocal(f->arguments[0], power * cln::cl_I_to_int(cln::numerator(*e)));
                }
                break;
            }
            case Kind::name: {
                const int signal = model_.signal_index(f->name);
                return GiNaC::pow(symbol({Atom::Kind::signal, signal, 0, f, f->name, {signal}, false}, true), power);
            }
            default: break;
        }
        if (inside.parameters) nonlinear(f, "beside a signal in a denominator");
        return GiNaC::pow(function_atom(f, true), power);
    }

    /// Multiplies the equation by its common denominator, which has parameters only; the sign is fixed by our own order.
    ex without_denominators(const ex& total) {
        bool fraction = false;
        for (const GiNaC::symbol& p : parameters_) fraction = fraction || total.ldegree(p) < 0 || !total.is_polynomial(p);
        if (!fraction) return total;
        const ex parts = total.numer_denom();
        ex numerator = parts.op(0).expand();
        const Polynomial denominator = to_polynomial(parts.op(1).expand(), parameters_);
        return (numerator / to_ginac(content(denominator))).expand();
    }

    void collect(const ex& term, std::map<Product, Polynomial>& sorted) const {
        Rational coefficient = 1;
        Exponents exponents(parameters_.size(), 0);
        std::map<int, int> powers;
        const auto take = [&](const ex& factor) {
            if (GiNaC::is_a<GiNaC::numeric>(factor)) {
                coefficient = coefficient * from_ginac(factor);
                return;
            }
            const bool is_power = GiNaC::is_a<GiNaC::power>(factor);
            const ex base = is_power ? factor.op(0) : factor;
            const int e = is_power ? GiNaC::ex_to<GiNaC::numeric>(factor.op(1)).to_int() : 1;
            for (std::size_t k = 0; k < parameters_.size(); ++k) if (base.is_equal(parameters_[k])) exponents[k] += e;
            for (std::size_t k = 0; k < symbols_.size(); ++k) {
                if (base.is_equal(symbols_[k])) powers[static_cast<int>(k)] += e;
                if (base.is_equal(reciprocals_[k])) powers[static_cast<int>(k)] -= e;
            }
        };
        if (GiNaC::is_a<GiNaC::mul>(term)) for (const ex& factor : term) take(factor);
        else take(term);
        Product product;
        for (const auto& [atom, power] : powers) if (power != 0) product.push_back({atom, power});
        sorted[product] = sum(sorted[product], Polynomial{{exponents, coefficient}});
    }

    const model::Model& model_;
    const model::Equation& equation_;
    Diagnostics& diagnostics_;
    std::vector<GiNaC::symbol> parameters_;
    NormalForms normal_forms_;
    std::vector<Atom> atoms_;
    std::vector<NormalForm> forms_;   // of the atoms
    std::vector<GiNaC::symbol> symbols_;
    std::vector<GiNaC::symbol> reciprocals_;
};

std::string joined(const OperatorForm& form, const Product& product, bool latex) {
    std::string above;
    std::string below;
    int factors_below = 0;
    for (const Factor& factor : product) {
        const Atom& atom = form.atoms[static_cast<std::size_t>(factor.atom)];
        const Kind kind = atom.formula->kind;
        std::string base = latex ? formula::latex(atom.formula) : atom.text;
        const int size = std::abs(factor.power);
        const bool plain = kind == Kind::name || kind == Kind::call;
        if (!plain) base = latex ? "\\left(" + base + "\\right)" : "(" + base + ")";
        if (size != 1) base = latex ? "{" + base + "}^{" + std::to_string(size) + "}" : base + "^" + std::to_string(size);
        std::string& side = factor.power > 0 ? above : below;
        if (factor.power < 0) ++factors_below;
        side += (side.empty() ? "" : latex ? "\\," : "*") + base;
    }
    if (above.empty()) above = "1";
    if (below.empty()) return above;
    if (latex) return "\\frac{" + above + "}{" + below + "}";
    return above + "/" + (factors_below > 1 ? "(" + below + ")" : below);
}

}  // namespace

int OperatorForm::order(const Product& product) const {
    if (product.size() != 1 || product[0].power != 1) return 0;
    const Atom& atom = atoms[static_cast<std::size_t>(product[0].atom)];
    return atom.kind == Atom::Kind::derivative ? atom.order : 0;
}

bool OperatorForm::is_constant(const Product& product) const {
    return std::all_of(product.begin(), product.end(), [&](const Factor& f) { return atoms[static_cast<std::size_t>(f.atom)].arguments.empty(); });
}

std::string OperatorForm::text(const Product& product) const { return joined(*this, product, false); }
std::string OperatorForm::latex(const Product& product) const { return joined(*this, product, true); }

std::optional<OperatorForm> operator_form(const model::Model& model, const model::Equation& equation, Diagnostics& diagnostics) {
    try {
        return Builder(model, equation, diagnostics).build();
    } catch (const NonlinearParameter& p) {
        diagnostics.error(equation.file, p.at, "parameter '" + p.name + "' stands " + p.where + ": the equation is not linear in it",
                          "declare it under [constants], or rewrite the term as a product of parameters and signals");
    } catch (const Stop&) {   // it has complained
    }
    return std::nullopt;
}

std::optional<NonlinearParameter> nonlinear_parameter(const model::Model& model, const model::Equation& equation) {
    Diagnostics unsaid;
    try {
        (void)Builder(model, equation, unsaid).build();
    } catch (const NonlinearParameter& p) {
        return p;
    } catch (const Stop&) {   // of another kind
    }
    return std::nullopt;
}

}  // namespace algest::equation
