// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/structural_identifiability.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "generator/combinations.hpp"
#include "generator/ginac_exact.hpp"
#include "generator/input_output.hpp"
#include "generator/modular_ideal.hpp"
#include "generator/suggestion.hpp"
#include "generator/taylor_rank.hpp"

namespace algest::structure {

namespace {

using GiNaC::ex;
using modular::Number;
using modular::Terms;
using modular::Vector;

class Judge {
public:
    Judge(const model::Model& model, const std::vector<std::string>& hidden, Diagnostics& diagnostics)
        : model_(model), names_(hidden), diagnostics_(diagnostics), symbols_(model), hidden_(model.signals.size(), false) {}

    std::optional<Structure> run() {
        if (!take_hidden()) return std::nullopt;
        try {
            auto triangle = structure::triangle(model_, hidden_, symbols_, diagnostics_);
            if (!triangle || !nothing_unmoved_is_hidden(*triangle)) return std::nullopt;
            list_signals(triangle->equations);
            unknowns_ = symbols_.parameters();
            unknowns_.insert(unknowns_.end(), symbols_.nuisances().begin(), symbols_.nuisances().end());
            if (!judge_locally(*triangle) || !free_of_ties(*triangle)) return std::nullopt;
            find_input_output(*triangle);
        } catch (const TooLong&) {
            diagnostics_.error(model_.path, {}, "multiplied out, the equations have more than " + std::to_string(static_cast<int>(most_terms)) + " terms", "write them with fewer sums under powers, or hide fewer signals");
            return std::nullopt;
        }
        combine();
        judge_globally();
        return std::move(out_);
    }

private:
    bool fail(const std::string& what, const std::string& right) {
        diagnostics_.error(model_.path, {}, what, right);
        return false;
    }

    bool take_hidden() {
        for (const std::string& name : names_) {
            const int s = model_.signal_index(name);
            if (s < 0) return fail("--hidden " + algest::quoted(name) + " is not a signal", did_you_mean(name, model::signal_names(model_)) + "name signals of the model");
            if (model_.signals[static_cast<std::size_t>(s)].formula) return fail("--hidden " + algest::quoted(name) + " is computed from measured signals", "hide what it is computed from");
            hidden_[static_cast<std::size_t>(s)] = true;
        }
        return true;
    }

    bool nothing_unmoved_is_hidden(const Triangle& triangle) {
        for (std::size_t s = 0; s < hidden_.size(); ++s) {
            const int signal = static_cast<int>(s);
            if (!hidden_[s]) continue;
            const bool moved = std::any_of(triangle.equations.begin(), triangle.equations.end(), [&](const Explicit& e) { return e.leader.signal == signal; });
            if (!moved) return fail("--hidden " + algest::quoted(model_.signals[s].name) + ": no equation moves it, so that nothing is known of it", "hide states, not inputs; or add the equation that moves it");
            for (const model::Delay& d : symbols_.delays()) {
                if (d.signal == signal) return fail("--hidden " + algest::quoted(model_.signals[s].name) + ": it is delayed, and the past of what nobody measures is unknown", "delay a measured signal");
            }
        }
        return true;
    }

    void add_measured(const formula::Formula& f, std::set<int>& used) const {
        for (const formula::Formula& a : f->arguments) add_measured(a, used);
        const int s = f->kind == formula::Kind::name ? model_.signal_index(f->name) : -1;
        if (s < 0) return;
        const model::Signal& signal = model_.signals[static_cast<std::size_t>(s)];
        if (signal.formula) add_measured(signal.formula, used);
        else used.insert(s);
    }

    void list_signals(const std::vector<Explicit>& equations) {
        std::set<int> used;
        for (const model::Equation& e : model_.equations) {
            add_measured(e.sides.left, used);
            add_measured(e.sides.right, used);
        }
        for (std::size_t s = 0; s < model_.signals.size(); ++s) {
            const int signal = static_cast<int>(s);
            const std::string& name = model_.signals[s].name;
            const bool moved = std::any_of(equations.begin(), equations.end(), [&](const Explicit& e) { return e.leader.signal == signal; });
            if (hidden_[s]) out_.hidden.push_back(name);
            else if (moved) out_.measured.push_back(name);
            else if (used.count(signal) > 0) out_.inputs.push_back(name);
        }
    }

    std::size_t parameters() const { return model_.parameters.size(); }

    Polynomial polynomial(const ex& e) const { return to_polynomial(e.expand(), unknowns_); }

    Vector unit(std::size_t k) const {
        Vector out(sensitivity_.columns);
        out[k] = 1;
        return out;
    }

    bool judge_locally(const Triangle& triangle) {
        auto found = sensitivity(triangle.equations, hidden_, symbols_);
        if (!found) return fail("the verdict is open: no point was found at which every sqrt() and every power k/2 has a value", "write a sqrt() of parameters, or of time, as a parameter of its own");
        sensitivity_ = std::move(*found);
        for (const ex& zero : triangle.implicit) add_rows_of(coefficients(zero, symbols_));
        for (std::size_t k = 0; k < parameters(); ++k) {
            const bool determined = sensitivity_.rows.contains(unit(k));
            out_.parameters.push_back({model_.parameters[k].name, determined ? Verdict::locally : Verdict::no, std::nullopt, sensitivity_.rows.touches(k)});
        }
        return true;
    }

    /// An equation that is solved for nothing: the ratios of its coefficients are what it determines.
    void add_rows_of(const Coefficients& c) {
        if (!c.whole) return;
        const Polynomial reference = polynomial(c.of_products.front());
        for (const ex& one : c.of_products) {
            const Polynomial p = polynomial(one);
            Vector row(sensitivity_.columns);
            for (std::size_t k = 0; k < unknowns_.size(); ++k) row[k] = at_point(derivative(p, k)) * at_point(reference) - at_point(p) * at_point(derivative(reference, k));
            of_implicit_.add(row);
            if (!sensitivity_.rows.add(row)) continue;
            sensitivity_.unknown_alone.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(parameters()), row.end());
        }
    }

    /// What other equations say of signals that an implicit one binds was judged as if these were free. Nothing hangs on that where the implicit
    /// one alone, whose coefficients show whatever the others give, determines every parameter.
    bool free_of_ties(const Triangle& triangle) {
        for (const Tie& tie : triangle.ties) {
            bool alone = tie.algebraic;
            for (std::size_t k = 0; k < parameters(); ++k) alone = alone && of_implicit_.contains(unit(k));
            if (alone) continue;
            const model::Equation& e = *tie.equation;
            diagnostics_.error(e.file, e.at, "the verdict is open: equation '" + e.name + "' is linear in no signal that it could be solved for, and " + tie.signal + " stands in another equation too",
                               "solve it for one of its signals, y = ..., or leave it out and put what it says into the others");
            return false;
        }
        return true;
    }

    Number at_point(const Polynomial& p) const { return modular::value_at(modular::from(p), sensitivity_.point); }

    /// The coefficients of the input-output equations, where these can be had.
    void find_input_output(const Triangle& triangle) {
        std::vector<ex> zeros = triangle.implicit;
        try {
            const auto equations = input_output(triangle.equations, hidden_, symbols_);
            all_found_ = equations.has_value();
            if (equations) zeros.insert(zeros.end(), equations->begin(), equations->end());
            for (const ex& zero : zeros) {
                const Coefficients c = coefficients(zero, symbols_);
                all_found_ = all_found_ && c.whole;
                if (!c.whole) continue;
                equations_.emplace_back();
                for (const ex& one : c.of_products) equations_.back().push_back(polynomial(one));
                std::sort(equations_.back().begin(), equations_.back().end(), [](const Polynomial& a, const Polynomial& b) {
                    return std::tuple(total_degree(a), a.size(), text_key(a)) < std::tuple(total_degree(b), b.size(), text_key(b));
                });
            }
        } catch (const TooLong&) {
            all_found_ = false;
            equations_.clear();
        }
    }

    /// An order that no address decides.
    static std::string text_key(const Polynomial& p) {
        std::string out;
        for (const auto& [exponents, c] : p) {
            for (const int e : exponents) out += std::to_string(e) + ",";
            out += exact::text(c) + ";";
        }
        return out;
    }

    void combine() {
        std::vector<int> open;
        for (std::size_t k = 0; k < parameters(); ++k) if (out_.parameters[k].verdict == Verdict::no) open.push_back(static_cast<int>(k));
        if (open.empty()) return;
        modular::RowSpace others;
        for (const Vector& row : sensitivity_.unknown_alone) others.add(row);
        const std::size_t count = sensitivity_.rows.rank() - others.rank() - (parameters() - open.size());
        const Vector own(sensitivity_.point.begin(), sensitivity_.point.begin() + static_cast<std::ptrdiff_t>(parameters()));
        combinations_ = combinations(open, ratios(open), count, sensitivity_.rows, sensitivity_.columns, own);
        std::vector<std::string> names;
        for (const model::Parameter& p : model_.parameters) names.push_back(p.name);
        for (std::size_t c = 0; c < combinations_.size(); ++c) {
            out_.combinations.push_back({algest::text(combinations_[c], names), Verdict::locally, std::nullopt});
            for (const int k : open) {
                const auto p = static_cast<std::size_t>(k);
                if (uses(combinations_[c].numerator, p) || uses(combinations_[c].denominator, p)) out_.parameters[p].seen_in.push_back(static_cast<int>(c));
            }
        }
    }

    /// Quotients of coefficients of one input-output equation that hold an open parameter and no perturbation; short ones first.
    std::vector<Quotient> ratios(const std::vector<int>& open) const {
        std::vector<Quotient> out;
        for (const auto& equation : equations_) {
            for (const Polynomial& p : equation) {
                const ex parts = (to_ginac(p, unknowns_) / to_ginac(equation.front(), unknowns_)).normal().numer_denom();
                const Quotient q = algest::reduced(Quotient{polynomial(parts.op(0)), polynomial(parts.op(1))});
                const auto has = [&](std::size_t k) { return uses(q.numerator, k) || uses(q.denominator, k); };
                bool fit = std::any_of(open.begin(), open.end(), [&](int k) { return has(static_cast<std::size_t>(k)); });
                for (std::size_t k = parameters(); k < unknowns_.size(); ++k) fit = fit && !has(k);
                if (fit) out.push_back(Quotient{without_last(q.numerator), without_last(q.denominator)});
            }
        }
        std::stable_sort(out.begin(), out.end(), [](const Quotient& a, const Quotient& b) { return a.numerator.size() + a.denominator.size() < b.numerator.size() + b.denominator.size(); });
        return out;
    }

    /// In the parameters alone.
    Polynomial without_last(const Polynomial& p) const {
        Polynomial out;
        for (const auto& [exponents, c] : p) out.emplace(Exponents(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(parameters())), c);
        return out;
    }

    /// In all variables of the ideal.
    Terms widened(const Polynomial& p, std::size_t variables) const {
        Terms out;
        for (const auto& [exponents, c] : modular::from(p)) {
            Exponents wide = exponents;
            wide.resize(variables, 0);
            out.emplace(wide, c);
        }
        return out;
    }

    static Terms variable(std::size_t k, std::size_t variables) {
        Exponents e(variables, 0);
        e[k] = 1;
        return {{e, 1}};
    }

    static Terms combined(const Terms& a, Number x, const Terms& b, Number y) {
        Terms out;
        for (const auto& [terms, factor] : {std::pair(&a, x), std::pair(&b, y)}) {
            for (const auto& [exponents, c] : *terms) {
                Number& sum = out[exponents];
                sum = sum + factor * c;
            }
        }
        std::erase_if(out, [](const auto& term) { return term.second.is_zero(); });
        return out;
    }

    static Terms times(const Terms& a, std::size_t k) {
        Terms out;
        for (const auto& [exponents, c] : a) {
            Exponents higher = exponents;
            ++higher[k];
            out.emplace(higher, c);
        }
        return out;
    }

    /// variable * below = above
    static Terms definition(std::size_t k, const Terms& above, const Terms& below) { return combined(times(below, k), 1, above, -1); }

    /// Parameters that give the same input-output equations as those at the point do. Unknowns that are open are held at other values.
    std::vector<Terms> same_equations(std::size_t variables) const {
        std::vector<Terms> out;
        const Terms one = {{Exponents(variables, 0), 1}};
        for (std::size_t e = 0; e < equations_.size(); ++e) {
            const Polynomial& reference = equations_[e].front();
            for (const Polynomial& p : equations_[e]) out.push_back(combined(widened(p, variables), at_point(reference), widened(reference, variables), Number(0) - at_point(p)));
            if (!is_constant(reference)) out.push_back(definition(unknowns_.size() + e, one, widened(reference, variables)));   // it is not zero
        }
        modular::RowSpace determined = sensitivity_.rows;
        modular::Draw draw(2);
        for (std::size_t k = 0; k < unknowns_.size(); ++k) {
            if (determined.add(unit(k))) out.push_back(combined(variable(k, variables), 1, one, Number(0) - draw.next()));
        }
        return out;
    }

    void settle(Judged& judged, std::optional<int> values) const {
        if (values == 1) judged.verdict = Verdict::globally;
        if (values == 1 || (all_found_ && values && *values > 1)) judged.values = values;
    }

    void judge_globally() {
        const std::size_t first_combination = unknowns_.size() + equations_.size();
        const std::size_t variables = first_combination + combinations_.size();
        auto basis = modular::groebner_basis(same_equations(first_combination));
        if (basis) {
            for (std::size_t k = 0; k < parameters(); ++k) {
                if (out_.parameters[k].verdict != Verdict::no) settle(out_.parameters[k], modular::values_of(k, *basis, first_combination));
            }
        }
        judge_delays();
        if (combinations_.empty()) return;
        std::vector<Terms> all = same_equations(variables);
        for (std::size_t c = 0; c < combinations_.size(); ++c) {
            all.push_back(definition(first_combination + c, widened(combinations_[c].numerator, variables), widened(combinations_[c].denominator, variables)));
        }
        basis = modular::groebner_basis(all);
        for (std::size_t c = 0; basis && c < combinations_.size(); ++c) settle(out_.combinations[c], modular::values_of(first_combination + c, *basis, variables));
    }

    /// A lateness that stands nowhere else, the only unknown one of its signal: inputs of different lateness are different functions.
    void judge_delays() {
        for (std::size_t k = 0; k < parameters(); ++k) {
            const auto mine = [&](const model::Delay& d) { return d.parameter == static_cast<int>(k); };
            const auto one = std::find_if(symbols_.delays().begin(), symbols_.delays().end(), mine);
            if (one == symbols_.delays().end() || out_.parameters[k].verdict != Verdict::locally || !all_found_) continue;
            const auto of_signal = std::count_if(symbols_.delays().begin(), symbols_.delays().end(), [&](const model::Delay& d) { return d.signal == one->signal; });
            const bool elsewhere = std::any_of(equations_.begin(), equations_.end(), [&](const auto& e) { return std::any_of(e.begin(), e.end(), [&](const Polynomial& p) { return uses(p, k); }); });
            if (of_signal == 1 && !elsewhere) settle(out_.parameters[k], 1);
        }
    }

    const model::Model& model_;
    const std::vector<std::string>& names_;
    Diagnostics& diagnostics_;
    Symbols symbols_;
    std::vector<bool> hidden_;
    std::vector<GiNaC::symbol> unknowns_;                // parameters, then coefficients of perturbations
    Sensitivity sensitivity_;
    modular::RowSpace of_implicit_;                      // what implicit equations alone determine
    bool all_found_ = false;                             // every input-output equation is in equations_
    std::vector<std::vector<Polynomial>> equations_;     // coefficients, in the unknowns; the simplest first
    std::vector<Quotient> combinations_;
    Structure out_;
};

/// A transfer function without common factors is known by its coefficients.
Structure of_samples(const model::Discrete& discrete) {
    Structure out{{discrete.output}, {discrete.input}, {}, {}, {}};
    for (const std::string& name : model::unknown_names(discrete)) out.parameters.push_back({name, Verdict::globally, 1});
    return out;
}

}  // namespace

std::string text(Verdict verdict) { return verdict == Verdict::globally ? "globally" : verdict == Verdict::locally ? "locally" : "not"; }

bool Structure::identifiable() const {
    return std::all_of(parameters.begin(), parameters.end(), [](const Judged& p) { return p.verdict != Verdict::no; });
}

std::optional<Structure> structural_identifiability(const model::Model& model, const std::vector<std::string>& hidden, Diagnostics& diagnostics) {
    if (model.discrete && hidden.empty()) return of_samples(*model.discrete);
    return Judge(model, hidden, diagnostics).run();
}

}  // namespace algest::structure
