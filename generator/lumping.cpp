// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/lumping.hpp"

#include <ginac/ginac.h>

#include <algorithm>

#include "generator/constrained_lumping.hpp"
#include "generator/ginac_exact.hpp"
#include "generator/identifiability.hpp"
#include "generator/polynomial_span.hpp"

namespace algest::lumping {

namespace {

using equation::OperatorForm;
using equation::Term;
using exact::Rational;
using GiNaC::ex;

class Lumper {
public:
    Lumper(const model::Model& model, const std::vector<OperatorForm>& forms, Diagnostics& diagnostics)
        : model_(model), forms_(forms), diagnostics_(diagnostics), variables_(model.parameters.size()) {
        for (const model::Parameter& p : model.parameters) names_.push_back(p.name);
    }

    std::optional<Lumping> run() {
        out_.inverse.resize(variables_);
        for (std::size_t e = 0; e < forms_.size(); ++e) {
            out_.equations.push_back({false, false, one(), -1, {}});
        }
        if (!every_parameter_is_kept()) return std::nullopt;
        const std::vector<Component> components = connected();
        for (std::size_t c = 0; c < components.size(); ++c) {
            if (!lump_component(components[c], static_cast<int>(c))) return std::nullopt;
        }
        return std::move(out_);
    }

private:
    Quotient one() const { return {constant(1, variables_), constant(1, variables_)}; }

    std::vector<int> parameters_of(std::size_t e, bool kept_only) const {
        std::vector<int> out;
        for (std::size_t k = 0; k < variables_; ++k) {
            for (const Term& term : forms_[e].terms) {
                if (uses(term.coefficient, k) && (!kept_only || kept(model_.equations[e], forms_[e], term))) {
                    out.push_back(static_cast<int>(k));
                    break;
                }
            }
        }
        return out;
    }

    bool every_parameter_is_kept() {
        bool good = true;
        for (std::size_t k = 0; k < variables_; ++k) {
            bool anywhere = false;
            bool seen = false;
            for (std::size_t e = 0; e < forms_.size(); ++e) {
                const auto all = parameters_of(e, false);
                const auto those = parameters_of(e, true);
                anywhere = anywhere || std::count(all.begin(), all.end(), static_cast<int>(k)) > 0;
                seen = seen || std::count(those.begin(), those.end(), static_cast<int>(k)) > 0;
            }
            const model::Parameter& p = model_.parameters[k];
            if (!anywhere) {
                diagnostics_.unidentifiable(model_.path, p.at, "parameter '" + p.name + "' stands in no equation", "remove it, or use it");
                good = false;
            } else if (!seen) {
                diagnostics_.unidentifiable(model_.path, p.at, "parameter '" + p.name + "' multiplies a constant, which kappa >= 1 erases",
                                            "set kappa = 0 in its equation, or declare it under [constants]");
                good = false;
            }
        }
        return good;
    }

    std::vector<Component> connected() const {
        std::vector<Component> out;
        std::vector<bool> taken(forms_.size(), false);
        for (std::size_t first = 0; first < forms_.size(); ++first) {
            if (taken[first] || parameters_of(first, true).empty()) continue;
            Component c;
            std::vector<std::size_t> open = {first};
            taken[first] = true;
            while (!open.empty()) {
                const std::size_t e = open.back();
                open.pop_back();
                c.equations.push_back(static_cast<int>(e));
                for (const int p : parameters_of(e, true)) {
                    if (std::find(c.parameters.begin(), c.parameters.end(), p) != c.parameters.end()) continue;
                    c.parameters.push_back(p);
                    for (std::size_t other = 0; other < forms_.size(); ++other) {
                        const auto theirs = parameters_of(other, true);
                        if (!taken[other] && std::count(theirs.begin(), theirs.end(), p) > 0) {
                            taken[other] = true;
                            open.push_back(other);
                        }
                    }
                }
            }
            std::sort(c.equations.begin(), c.equations.end());
            std::sort(c.parameters.begin(), c.parameters.end());
            out.push_back(c);
        }
        return out;
    }

    const Polynomial& leading(int e) const {
        const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
        if (form.leading >= 0) return form.terms[static_cast<std::size_t>(form.leading)].coefficient;
        return std::find_if(form.terms.begin(), form.terms.end(), [&](const Term& t) { return kept(model_.equations[static_cast<std::size_t>(e)], form, t); })->coefficient;
    }

    template <class Use>
    void each_term(const Component& c, Use use) const {
        for (const int e : c.equations) {
            const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
            for (std::size_t k = 0; k < form.terms.size(); ++k) {
                if (kept(model_.equations[static_cast<std::size_t>(e)], form, form.terms[k])) use(e, static_cast<int>(k), form.terms[k]);
            }
        }
    }

    bool linear_as_written(const Component& c) const {
        bool linear = true;
        each_term(c, [&](int, int, const Term& term) { linear = linear && total_degree(term.coefficient) <= 1; });
        return linear;
    }

    /// Everything over the product of the different leading coefficients, as combinations of that product (known) and unknowns.
    struct Divided {
        Polynomial denominator;
        std::vector<Polynomial> unknowns;
        std::vector<LumpedTerm> terms;   // in the order of each_term; unknowns numbered from 0
        std::vector<int> equations;
    };

    Divided divided(const Component& c) const {
        Divided out;
        std::vector<Polynomial> different;
        for (const int e : c.equations) {
            if (std::find(different.begin(), different.end(), leading(e)) == different.end()) different.push_back(leading(e));
        }
        const auto others = [&](const Polynomial& mine) {
            Polynomial p = constant(1, variables_);
            for (const Polynomial& d : different) if (d != mine) p = product(p, d);
            return p;
        };
        out.denominator = product(different[0], others(different[0]));
        Span span;
        span.add(span.reduce(out.denominator), 1);
        each_term(c, [&](int e, int k, const Term& term) {
            out.terms.push_back(lumped_term(k, span.express(product(term.coefficient, others(leading(e))), out.unknowns)));
            out.equations.push_back(e);
        });
        return out;
    }

    /// Terms of the product of the different leading coefficients, at most: what dividing has to multiply out.
    double size_of_denominator(const Component& c) const {
        std::vector<Polynomial> different;
        double size = 1;
        for (const int e : c.equations) {
            if (std::find(different.begin(), different.end(), leading(e)) != different.end()) continue;
            different.push_back(leading(e));
            size *= static_cast<double>(leading(e).size());
        }
        return size;
    }

    bool lump_component(const Component& c, int number) {
        const bool can_divide = size_of_denominator(c) <= 64;
        if (const Undetermined open = undetermined(model_, forms_, c, false); open.missing > 0) {
            return refuse_shortage(c, open, can_divide ? "enter only through " + seen(divided(c)) : "enter only together");
        }
        const bool ties = std::any_of(forms_.begin(), forms_.end(), without_parameters);
        if (ties) {
            if (const Undetermined open = undetermined(model_, forms_, c, true); open.missing > 0) return refuse_tied(c, open);
        }
        const bool linear = linear_as_written(c);
        if (!can_divide) {
            if (linear) return take_as_written(c, number);
            const model::Equation& equation = model_.equations[static_cast<std::size_t>(c.equations[0])];
            diagnostics_.error(model_.path, equation.at, "the leading coefficients of the equations that share parameters are too long to divide by", "name sums of parameters as parameters of their own");
            return false;
        }
        const Divided quotient = divided(c);
        const std::size_t physical = c.parameters.size();
        if (linear && physical < quotient.unknowns.size()) return take_as_written(c, number);
        if (quotient.unknowns.size() > physical) return refuse_surplus(c, quotient);
        return take_divided(c, quotient, number);
    }

    std::string meaning_text(const Polynomial& unknown, const Polynomial& denominator) const {
        return text(simplified({unknown, denominator}), names_);
    }

    std::string list(const std::vector<int>& parameters) const {
        std::string out;
        for (const int p : parameters) out += (out.empty() ? "" : ", ") + names_[static_cast<std::size_t>(p)];
        return out;
    }

    std::string seen(const Divided& quotient) const {
        std::string out;
        for (const Polynomial& u : quotient.unknowns) out += (out.empty() ? "" : ", ") + meaning_text(u, quotient.denominator);
        return out.empty() ? "nothing" : shortened(out);
    }

    static constexpr double most_terms = 2000;
    static constexpr std::size_t longest_text = 150;

    /// A formula in a message.
    static std::string shortened(const std::string& formula) {
        return formula.size() <= longest_text ? formula : formula.substr(0, longest_text) + "...";
    }

    bool refuse_inverse(const Component& c, const std::vector<int>& parameters, const std::string& how) {
        diagnostics_.error(model_.path, model_.equations[static_cast<std::size_t>(c.equations[0])].at,
                           "the combinations that the rows see cannot be solved for " + list(parameters) + " " + how, "name the combinations as parameters of their own");
        return false;
    }

    bool refuse_surplus(const Component& c, const Divided& quotient) {
        std::string term = "?";
        int where = c.equations[0];
        bool found = false;
        each_term(c, [&](int e, int, const Term& t) {
            if (found || total_degree(t.coefficient) <= 1) return;
            const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
            term = shortened("(" + text(t.coefficient, names_) + ")*" + form.text(t.product));
            where = e;
            found = true;
        });
        const model::Equation& equation = model_.equations[static_cast<std::size_t>(where)];
        diagnostics_.error(model_.path, equation.at,
                           "equation '" + equation.name + "' is linear only in " + std::to_string(quotient.unknowns.size()) + " products (" + seen(quotient) + ") of its " +
                               std::to_string(c.parameters.size()) + " parameters, because of the term " + term,
                           "use solve = \"elimination\", declare a parameter of that term under [constants], or name the product as a parameter of its own");
        return false;
    }

    bool refuse_shortage(const Component& c, const Undetermined& open, const std::string& how) {
        const model::Equation& equation = model_.equations[static_cast<std::size_t>(c.equations[0])];
        diagnostics_.unidentifiable(model_.path, equation.at, "the " + std::to_string(c.parameters.size()) + " parameters " + list(c.parameters) + " " + how,
                                    "declare " + choice(open, names_) + " under [constants], or name these combinations as parameters");
        return false;
    }

    bool refuse_tied(const Component& c, const Undetermined& open) {
        const model::Equation& equation = model_.equations[static_cast<std::size_t>(c.equations[0])];
        diagnostics_.unidentifiable(model_.path, equation.at, list(open.parameters) + " cannot be told apart: an equation without unknowns ties the signals beside them together",
                                    "declare " + choice(open, names_) + " under [constants], or write what one signal is by the others");
        return false;
    }

    /// Every parameter is an unknown.
    bool take_as_written(const Component& c, int number) {
        const int first = static_cast<int>(out_.unknowns.size());
        for (const int p : c.parameters) {
            Exponents e(variables_, 0);
            e[static_cast<std::size_t>(p)] = 1;
            out_.inverse[static_cast<std::size_t>(p)] = identity(static_cast<int>(out_.unknowns.size()));
            out_.unknowns.push_back({names_[static_cast<std::size_t>(p)], {Polynomial{{e, 1}}, constant(1, variables_)}, number});
        }
        each_term(c, [&](int e, int k, const Term& term) {
            LumpedTerm lumped{k, 0, {}};
            for (const auto& [exponents, coefficient] : term.coefficient) {
                const auto at = std::find(exponents.begin(), exponents.end(), 1);
                if (at == exponents.end()) {
                    lumped.known = coefficient;
                    continue;
                }
                const int p = static_cast<int>(at - exponents.begin());
                const auto local = std::find(c.parameters.begin(), c.parameters.end(), p) - c.parameters.begin();
                lumped.unknown.emplace_back(first + static_cast<int>(local), coefficient);
            }
            keep(e, lumped, number, false, one());
        });
        return true;
    }

    Quotient identity(int unknown) const {
        Exponents e(static_cast<std::size_t>(unknown) + 1, 0);
        e[static_cast<std::size_t>(unknown)] = 1;
        return {Polynomial{{e, 1}}, constant(1, e.size())};
    }

    void keep(int e, const LumpedTerm& term, int component, bool is_divided, const Quotient& lead) {
        LumpedEquation& equation = out_.equations[static_cast<std::size_t>(e)];
        equation.used = true;
        equation.component = component;
        equation.divided = is_divided;
        equation.leading = lead;
        equation.terms.push_back(term);
    }

    bool take_divided(const Component& c, const Divided& quotient, int number) {
        const int first = static_cast<int>(out_.unknowns.size());
        for (const Polynomial& u : quotient.unknowns) {
            const Quotient meaning = simplified({u, quotient.denominator});
            out_.unknowns.push_back({unknown_name(meaning), meaning, number});
        }
        for (std::size_t k = 0; k < quotient.terms.size(); ++k) {
            LumpedTerm term = quotient.terms[k];
            for (auto& [unknown, factor] : term.unknown) unknown += first;
            const int e = quotient.equations[k];
            const Polynomial& lead = leading(e);
            keep(e, term, number, !(is_constant(lead) && lead.begin()->second == 1), {lead, constant(1, variables_)});
        }
        return invert(c, first);
    }

    /// The parameter's own name where the unknown is that parameter, else the next Gamma.
    std::string unknown_name(const Quotient& meaning) {
        const bool plain = is_constant(meaning.denominator) && meaning.numerator.size() == 1 && total_degree(meaning.numerator) == 1 &&
                           meaning.numerator.begin()->second == 1;
        if (plain) return text(meaning, names_);
        std::string name;
        do {
            name = "Gamma" + std::to_string(++gammas_);
        } while (model_.signal(name) != nullptr || model_.parameter(name) != nullptr || model_.constant(name) != nullptr);
        return name;
    }

    /// Common factors removed, signs and order ours.
    Quotient simplified(const Quotient& q) const {
        std::vector<GiNaC::symbol> symbols;
        for (const std::string& n : names_) symbols.emplace_back(n);
        const ex parts = (to_ginac(q.numerator, symbols) / to_ginac(q.denominator, symbols)).normal().numer_denom();
        return reduced({to_polynomial(parts.op(0).expand(), symbols), to_polynomial(parts.op(1).expand(), symbols)});
    }

    /// Solves unknown_k = meaning_k for the parameters, one after the other, always one that stands linearly.
    bool invert(const Component& c, int first) {
        std::vector<GiNaC::symbol> symbols;
        for (const std::string& n : names_) symbols.emplace_back(n);
        std::vector<GiNaC::symbol> unknowns;
        for (const Unknown& u : out_.unknowns) unknowns.emplace_back("G" + u.name);
        std::vector<ex> equations;
        for (std::size_t k = static_cast<std::size_t>(first); k < out_.unknowns.size(); ++k) {
            const Quotient& m = out_.unknowns[k].meaning;
            equations.push_back((unknowns[k] * to_ginac(m.denominator, symbols) - to_ginac(m.numerator, symbols)).expand());
        }
        std::vector<int> open = c.parameters;
        std::vector<std::pair<int, ex>> solved;
        while (!open.empty()) {
            const auto choice = most_lonely(equations, open, symbols);
            if (!choice) return refuse_inverse(c, open, "by rational operations");
            const auto [e, p] = *choice;
            const GiNaC::symbol& x = symbols[static_cast<std::size_t>(p)];
            const ex solution = (-equations[e].coeff(x, 0) / equations[e].coeff(x, 1)).normal();
            equations.erase(equations.begin() + static_cast<std::ptrdiff_t>(e));
            double terms = 0;
            for (const ex& other : equations) terms += terms_after(other, x, solution);
            for (const auto& [q, earlier] : solved) {
                const ex parts = earlier.numer_denom();
                terms += terms_after(parts.op(0).expand(), x, solution) + terms_after(parts.op(1).expand(), x, solution);
            }
            if (terms > most_terms) return refuse_inverse(c, c.parameters, "in fewer than " + std::to_string(static_cast<int>(most_terms)) + " terms");
            for (const auto& [q, earlier] : solved) {
                if (earlier.denom().subs(x == solution).normal().is_zero()) return refuse_inverse(c, c.parameters, "at any value: a denominator vanishes");
            }
            for (ex& other : equations) other = other.subs(x == solution).normal().numer().expand();
            for (auto& [q, earlier] : solved) earlier = earlier.subs(x == solution).normal();
            solved.emplace_back(p, solution);
            open.erase(std::find(open.begin(), open.end(), p));
        }
        for (const auto& [p, solution] : solved) {
            const ex parts = solution.normal().numer_denom();
            out_.inverse[static_cast<std::size_t>(p)] = reduced({to_polynomial(parts.op(0).expand(), unknowns), to_polynomial(parts.op(1).expand(), unknowns)});
        }
        return gives_back(c) || refuse_inverse(c, c.parameters, "by rational operations");
    }

    /// True when the inverse undoes the meanings. It may not: a square that is multiplied by a denominator can lose a degree where
    /// the two have a factor in common, and what is then solved is that factor.
    bool gives_back(const Component& c) const {
        const std::vector<Rational> point = generic_point(variables_);
        std::vector<Rational> unknowns;
        for (const Unknown& u : out_.unknowns) unknowns.push_back(value_at(u.meaning.numerator, point) / value_at(u.meaning.denominator, point));
        return std::all_of(c.parameters.begin(), c.parameters.end(), [&](int p) {
            const Quotient& inverse = *out_.inverse[static_cast<std::size_t>(p)];
            const Rational below = value_at(inverse.denominator, unknowns);
            return !cln::zerop(below) && value_at(inverse.numerator, unknowns) == below * point[static_cast<std::size_t>(p)];
        });
    }

    static double terms_of(const ex& expanded) { return GiNaC::is_a<GiNaC::add>(expanded) ? static_cast<double>(expanded.nops()) : 1; }

    /// Terms of an expanded polynomial after x is replaced, at most.
    static double terms_after(const ex& polynomial, const GiNaC::symbol& x, const ex& solution) {
        const ex parts = solution.numer_denom();
        const double terms = terms_of(parts.op(0).expand()) + terms_of(parts.op(1).expand()) - 1;
        double out = terms_of(polynomial);
        for (int k = 0; k < polynomial.degree(x) && out <= most_terms; ++k) out *= terms;
        return out;
    }

    /// The equation and open parameter in which the equation is linear, with the fewest other open parameters beside it.
    static std::optional<std::pair<std::size_t, int>> most_lonely(const std::vector<ex>& equations, const std::vector<int>& open, const std::vector<GiNaC::symbol>& symbols) {
        std::optional<std::pair<std::size_t, int>> best;
        int least = 0;
        for (std::size_t e = 0; e < equations.size(); ++e) {
            for (const int p : open) {
                const GiNaC::symbol& x = symbols[static_cast<std::size_t>(p)];
                if (equations[e].degree(x) != 1 || equations[e].coeff(x, 1).is_zero()) continue;
                int others = 0;
                for (const int q : open) if (q != p && equations[e].has(symbols[static_cast<std::size_t>(q)])) ++others;
                if (!best || others < least) {
                    best = {e, p};
                    least = others;
                }
            }
        }
        return best;
    }

    const model::Model& model_;
    const std::vector<OperatorForm>& forms_;
    Diagnostics& diagnostics_;
    std::size_t variables_;
    std::vector<std::string> names_;
    Lumping out_;
    int gammas_ = 0;
};

}  // namespace

LumpedTerm lumped_term(int term, const std::vector<Rational>& over) {
    LumpedTerm out{term, over[0], {}};
    for (std::size_t g = 1; g < over.size(); ++g) {
        if (!cln::zerop(over[g])) out.unknown.emplace_back(static_cast<int>(g - 1), over[g]);
    }
    return out;
}

std::optional<Lumping> lump(const model::Model& model, const std::vector<OperatorForm>& forms, Diagnostics& diagnostics) {
    if (model.estimator.solve == model::Solver::elimination) return lump_constrained(model, forms, diagnostics);
    return Lumper(model, forms, diagnostics).run();
}

}  // namespace algest::lumping
