// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/constrained_lumping.hpp"

#include <algorithm>
#include <set>

#include "generator/elimination.hpp"
#include "generator/identifiability.hpp"
#include "generator/polynomial_span.hpp"
#include "generator/suggestion.hpp"

namespace algest::lumping {

namespace {

using equation::OperatorForm;
using equation::Term;
using exact::Rational;

/// The columns of a stage, and each kept term's coefficient over 1 and them.
struct Columns {
    std::vector<Polynomial> meaning;
    std::vector<LumpedTerm> terms;
    std::vector<int> equations;   ///< of the terms
};

class ConstrainedLumper {
public:
    ConstrainedLumper(const model::Model& model, const std::vector<OperatorForm>& forms, Diagnostics& diagnostics)
        : model_(model), forms_(forms), diagnostics_(diagnostics), variables_(model.parameters.size()), known_(variables_, false) {
        for (const model::Parameter& p : model.parameters) names_.push_back(p.name);
    }

    std::optional<Lumping> run() {
        out_.elimination.emplace();
        out_.inverse.resize(variables_);
        for (std::size_t e = 0; e < forms_.size(); ++e) out_.equations.push_back({false, false, {constant(1, variables_), constant(1, variables_)}, -1, {}});
        for (const model::Parameter& p : model_.parameters) {
            sizes_.push_back(p.initial && !cln::zerop(*p.initial) ? exact::power_of_two_near_root(*p.initial * *p.initial) : Rational(1));
            out_.elimination->sizes.push_back(exact::nearest(sizes_.back(), plan::Scalar::float64));
        }
        if (!stages_are_equations()) return std::nullopt;
        for (const std::vector<int>& equations : stages()) if (!lump(equations)) return std::nullopt;
        if (!every_equation_has_a_stage() || !every_parameter_is_found()) return std::nullopt;
        return std::move(out_);
    }

private:
    std::vector<std::vector<int>> stages() const {
        std::vector<std::vector<int>> out;
        for (const model::Mention& m : model_.estimator.stages) out.push_back({equation_index(m.name)});
        if (!out.empty()) return out;
        out.emplace_back();
        for (std::size_t e = 0; e < forms_.size(); ++e) if (!without_parameters(forms_[e])) out[0].push_back(static_cast<int>(e));
        return out;
    }

    int equation_index(const std::string& name) const {
        const auto found = std::find_if(model_.equations.begin(), model_.equations.end(), [&](const model::Equation& e) { return e.name == name; });
        return found == model_.equations.end() ? -1 : static_cast<int>(found - model_.equations.begin());
    }

    /// Every stage is an equation with parameters, each of them once.
    bool stages_are_equations() {
        std::vector<std::string> names;
        for (const model::Equation& e : model_.equations) names.push_back(e.name);
        std::set<int> taken;
        for (const model::Mention& m : model_.estimator.stages) {
            const int e = equation_index(m.name);
            const std::string wrong = e < 0 ? "is no equation" : without_parameters(forms_[static_cast<std::size_t>(e)]) ? "has no parameters" : taken.insert(e).second ? "" : "is there twice";
            if (wrong.empty()) continue;
            diagnostics_.error(model_.path, m.at, "'" + m.name + "' " + wrong, (e < 0 ? did_you_mean(m.name, names) : std::string()) + "list the names of equations in the order in which they are to be solved");
            return false;
        }
        return true;
    }

    const model::Equation& equation(int e) const { return model_.equations[static_cast<std::size_t>(e)]; }

    bool lump(const std::vector<int>& equations) {
        std::vector<bool> unknown(variables_, false);
        Component component{equations, {}};
        for (std::size_t p = 0; p < variables_; ++p) {
            unknown[p] = !known_[p] && std::any_of(equations.begin(), equations.end(), [&](int e) { return holds(e, p); });
            if (unknown[p]) component.parameters.push_back(static_cast<int>(p));
        }
        if (!std::all_of(equations.begin(), equations.end(), [&](int e) { return has_known_side(e) && asks_no_perturbation(e); })) return false;
        if (const Undetermined open = undetermined(model_, forms_, component, true); open.missing > 0) return refuse_open(component, open);
        const Columns columns = columns_of(equations);
        const elimination::Outcome outcome = elimination::sort_columns(columns.meaning, unknown, sizes_);
        if (!outcome.too_many.empty() || outcome.too_high) return refuse_complexity(equations, outcome);
        take(equations, columns, outcome.sorted);
        for (const int p : component.parameters) known_[static_cast<std::size_t>(p)] = true;
        return true;
    }

    bool holds(int e, std::size_t p) const {
        const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
        return std::any_of(form.terms.begin(), form.terms.end(), [&](const Term& t) { return uses(t.coefficient, p) && kept(equation(e), form, t); });
    }

    /// Least squares of what is linear and without a known side would give zero.
    bool has_known_side(int e) {
        const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
        const Exponents none(variables_, 0);
        if (std::any_of(form.terms.begin(), form.terms.end(), [&](const Term& t) { return t.coefficient.count(none) > 0 && kept(equation(e), form, t); })) return true;
        diagnostics_.error(model_.path, equation(e).at, "every term of equation '" + equation(e).name + "' has a parameter: elimination needs one that has none",
                           "divide the equation by a parameter, and name the quotients as parameters of their own");
        return false;
    }

    bool asks_no_perturbation(int e) {
        if (equation(e).perturbation.empty()) return true;
        diagnostics_.error(model_.path, equation(e).perturbation_at, "a perturbation is not to be had with elimination", "use another solve, or leave it out");
        return false;
    }

    template <class Use>
    void each_term(const std::vector<int>& equations, Use use) const {
        for (const int e : equations) {
            const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
            for (std::size_t k = 0; k < form.terms.size(); ++k) if (kept(equation(e), form, form.terms[k])) use(e, static_cast<int>(k), form.terms[k].coefficient);
        }
    }

    /// Products of parameters, in the order in which they occur.
    Columns by_products(const std::vector<int>& equations) const {
        Columns out;
        std::vector<Exponents> products;
        each_term(equations, [&](int e, int k, const Polynomial& coefficient) {
            LumpedTerm term{k, 0, {}};
            for (const auto& [exponents, c] : coefficient) {
                if (std::all_of(exponents.begin(), exponents.end(), [](int x) { return x == 0; })) {
                    term.known = c;
                    continue;
                }
                std::size_t at = static_cast<std::size_t>(std::find(products.begin(), products.end(), exponents) - products.begin());
                if (at == products.size()) {
                    products.push_back(exponents);
                    out.meaning.push_back(Polynomial{{exponents, 1}});
                }
                term.unknown.emplace_back(static_cast<int>(at), c);
            }
            out.terms.push_back(term);
            out.equations.push_back(e);
        });
        return out;
    }

    /// Combinations of products that are enough.
    Columns by_combinations(const std::vector<int>& equations) const {
        Columns out;
        Span span;
        span.add(span.reduce(constant(1, variables_)), 1);
        each_term(equations, [&](int e, int k, const Polynomial& coefficient) {
            out.terms.push_back(lumped_term(k, span.express(coefficient, out.meaning)));
            out.equations.push_back(e);
        });
        return out;
    }

    Columns columns_of(const std::vector<int>& equations) const {
        Columns products = by_products(equations);
        Columns combinations = by_combinations(equations);
        return combinations.meaning.size() < products.meaning.size() ? combinations : products;
    }

    void take(const std::vector<int>& equations, const Columns& columns, const elimination::Sorted& sorted) {
        const int number = static_cast<int>(out_.elimination->stages.size());
        plan::EliminationStage stage = sorted.stage;
        stage.first_column = static_cast<int>(out_.unknowns.size());
        for (const int e : equations) stage.equations.push_back(equation(e).name);
        std::vector<int> place(columns.meaning.size());
        for (std::size_t k = 0; k < sorted.order.size(); ++k) {
            const Polynomial& meaning = columns.meaning[static_cast<std::size_t>(sorted.order[k])];
            place[static_cast<std::size_t>(sorted.order[k])] = static_cast<int>(out_.unknowns.size());
            out_.unknowns.push_back({"Gamma" + std::to_string(out_.unknowns.size() + 1), {meaning, constant(1, variables_)}, number});
        }
        for (std::size_t k = 0; k < columns.terms.size(); ++k) {
            LumpedTerm term = columns.terms[k];
            for (auto& [unknown, factor] : term.unknown) unknown = place[static_cast<std::size_t>(unknown)];
            LumpedEquation& to = out_.equations[static_cast<std::size_t>(columns.equations[k])];
            to.used = true;
            to.component = number;
            to.terms.push_back(term);
        }
        for (const int e : equations) out_.equations[static_cast<std::size_t>(e)].used = true;
        out_.elimination->stages.push_back(std::move(stage));
    }

    std::string list(const std::vector<int>& parameters) const {
        std::string out;
        for (const int p : parameters) out += (out.empty() ? "" : ", ") + names_[static_cast<std::size_t>(p)];
        return out;
    }

    bool refuse_open(const Component& c, const Undetermined& open) {
        diagnostics_.unidentifiable(model_.path, equation(c.equations[0]).at, list(open.parameters) + " cannot be told apart by what equation '" + equation(c.equations[0]).name + "' says of them",
                                    "declare " + choice(open, names_) + " under [constants], or name what is seen of them as a parameter of its own");
        return false;
    }

    /// Names a term with a product of the parameters in question.
    bool refuse_complexity(const std::vector<int>& equations, const elimination::Outcome& outcome) {
        std::string term;
        int where = equations[0];
        each_term(equations, [&](int e, int k, const Polynomial& coefficient) {
            if (!term.empty() || total_degree(coefficient) <= 1) return;
            const OperatorForm& form = forms_[static_cast<std::size_t>(e)];
            term = "(" + text(coefficient, names_) + ")*" + form.text(form.terms[static_cast<std::size_t>(k)].product);
            where = e;
        });
        const std::string what = outcome.too_high ? "the resultant of the extremum equations is of too high a degree"
                                                  : "elimination handles two parameters that stand in more than one product, here are " + std::to_string(outcome.too_many.size()) + ": " + list(outcome.too_many);
        diagnostics_.error(model_.path, equation(where).at, what + ", because of the term " + term,
                           "declare one of them under [constants], solve an equation that has fewer of them first with stages = [...], or name a product as a parameter of its own");
        return false;
    }

    bool every_equation_has_a_stage() {
        for (std::size_t e = 0; e < forms_.size(); ++e) {
            if (out_.equations[e].used || without_parameters(forms_[e])) continue;
            diagnostics_.error(model_.path, model_.estimator.stages[0].at, "stages leaves out equation '" + model_.equations[e].name + "'", "list every equation with parameters");
            return false;
        }
        return true;
    }

    bool every_parameter_is_found() {
        for (std::size_t p = 0; p < variables_; ++p) {
            if (known_[p]) continue;
            diagnostics_.unidentifiable(model_.path, model_.parameters[p].at, "no row sees parameter '" + names_[p] + "'",
                                        "use it in an equation outside of derivatives and constants that the rows do not keep, or declare it under [constants]");
            return false;
        }
        return true;
    }

    const model::Model& model_;
    const std::vector<OperatorForm>& forms_;
    Diagnostics& diagnostics_;
    std::size_t variables_;
    std::vector<std::string> names_;
    std::vector<Rational> sizes_;
    std::vector<bool> known_;   ///< parameters of the stages so far
    Lumping out_;
};

}  // namespace

std::optional<Lumping> lump_constrained(const model::Model& model, const std::vector<OperatorForm>& forms, Diagnostics& diagnostics) {
    return ConstrainedLumper(model, forms, diagnostics).run();
}

}  // namespace algest::lumping
