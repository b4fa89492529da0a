// SPDX-License-Identifier: GPL-3.0-or-later
// Model -> plan: which rows, which tables, which weights, which map back.
#include "generator/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "generator/delay.hpp"
#include "generator/discrete_plan.hpp"
#include "generator/engine.hpp"
#include "generator/generate.hpp"
#include "generator/lumping.hpp"
#include "generator/model.hpp"
#include "generator/names.hpp"
#include "generator/noise_channels.hpp"
#include "generator/noise_floor.hpp"
#include "generator/plan_limits.hpp"
#include "generator/plan_parameters.hpp"
#include "generator/plan_solver.hpp"
#include "generator/planner.hpp"
#include "generator/row_choice.hpp"
#include "generator/row_functional.hpp"
#include "generator/row_weight.hpp"
#include "generator/single_precision.hpp"
#include "generator/steady_state.hpp"
#include "generator/tape_builder.hpp"

namespace algest::generator {

namespace {

using equation::OperatorForm;
using exact::Rational;

constexpr int longest_delay = 10000;   ///< sampling periods: a ring in every instance

class Planner {
public:
    Planner(const model::Model& model, const PlanOptions& options, Diagnostics& diagnostics)
        : model_(model), options_(options), diagnostics_(diagnostics) {}

    std::optional<plan::Plan> run() {
        if (!what_is_missing() || !growing_serves(model_, diagnostics_)) return std::nullopt;
        if (model_.discrete) return run_discrete();
        const auto forms = operator_forms(model_, diagnostics_);
        if (!forms) return std::nullopt;
        forms_ = *forms;
        const auto lumping = lumping::lump(model_, forms_, diagnostics_);
        if (!lumping) return std::nullopt;
        lumping_ = *lumping;
        if (model_.estimator.functional == model::Functional::derivative && !hold_at_instants(model_, lumping_, forms_, diagnostics_)) return std::nullopt;
        const auto rows = choose_rows(model_, lumping_, diagnostics_);
        if (!rows) return std::nullopt;
        rows_ = *rows;
        functional_ = row_functional(model_, forms_, options_.scalar);
        const auto weights = row_weights(model_, forms_, lumping_, rows_, *functional_, diagnostics_);
        if (!weights) return std::nullopt;

        head();
        plan_.functional = functional_->kind();
        plan_.intervals = functional_->intervals();
        equations();
        if (!inputs() || !past_inputs()) return std::nullopt;
        plan_solver(model_, plan_);
        tables_and_rows(*weights);
        plan_parameters(model_, lumping_, plan_);
        plan_.kept = plan_.moments ? 0 : kept_samples(plan_.solve, plan_.solve_instants, plan_.uncertain(), !plan_.perturbation.empty());
        if (diagnostics_.failed()) return std::nullopt;
        if (!noise_suffices(model_, noise_.through_a_filter, plan_, diagnostics_)) return std::nullopt;
        plan_.noise_floor = noise_floor(plan_);
        for (const std::string& note : single_precision_notes(model_, lumping_, plan_)) plan_.notes.push_back(note);
        if (!within_limits(model_, plan_, diagnostics_)) return std::nullopt;
        return std::move(plan_);
    }

private:
    std::optional<plan::Plan> run_discrete() {
        head();
        if (model_.window) plan_.intervals = cln::cl_I_to_int(cln::numerator(*model_.window / *model_.period));
        plan_solver(model_, plan_);
        plan_discrete(model_, options_, plan_);
        margin_of_discrete_rows();
        plan_.moments = moments(model_, options_.engine, plan_, diagnostics_);   // says that they will not do
        plan_.kept = kept_samples(plan_.solve, 0, false, false);
        if (!within_limits(model_, plan_, diagnostics_)) return std::nullopt;
        return std::move(plan_);
    }

    void margin_of_discrete_rows() {
        if (!plan_.normalise) return;
        const model::Signal& output = *model_.signal(model_.discrete->output);
        while (plan_.inputs[static_cast<std::size_t>(plan_.output)].name != output.name) ++plan_.output;
        const std::optional<exact::Rational> noise = output.deviation();
        if (noise && model_.estimator.uncertainty.value_or(true)) plan_.output_noise = exact::nearest(*noise, plan_.scalar);
        plan_.noise_floor = noise_of_rows(plan_);
        if (!plan_.noise_floor.empty()) plan_.margin_over_noise = floor_over_noise;
    }

    bool what_is_missing() {
        const bool pooled_samples = model_.discrete && model_.estimator.solve == model::Solver::least_squares;
        if (!model_.period) diagnostics_.error(model_.path, model_.sampling_at, "no sampling period", "add [sampling] period = 1e-3, in seconds");
        if (!model_.window && model_.estimator.has_window() && !pooled_samples) {
            diagnostics_.error(model_.path, model_.sampling_at, "no window: an estimator needs one",
                               "add [sampling] window = " + exact::decimal(100 * model_.period.value_or(Rational(1) / 1000)) + ", in seconds: long against noise, short against what changes; `algest design` finds one on a recording");
        }
        if (model_.parameters.empty() && !model_.discrete) diagnostics_.error(model_.path, {1, 1}, "nothing to estimate: no unknowns", "declare [parameters], or unknowns of [transfer]");
        return !diagnostics_.has_errors();
    }

    bool averages() const { return model_.estimator.functional == model::Functional::average; }

    void head() {
        plan_.name = model_.name;
        plan_.class_name = model::class_name(model_.name);
        plan_.summary = model_.summary;
        plan_.source = model_.source;
        plan_.scalar = options_.scalar;
        plan_.period_text = exact::text(*model_.period);
        plan_.period = exact::nearest(*model_.period, plan::Scalar::float64);
        plan_.rate = exact::nearest(1 / *model_.period, options_.scalar);
        plan_.decimate = model_.decimate;
        plan_.quadrature = model_.estimator.quadrature;
        if (!model_.estimator.given) plan_.notes.push_back("no [estimator] in the model: solve = \"square\"");
    }

    void equations() {
        std::vector<std::string> names;
        for (const lumping::Unknown& u : lumping_.unknowns) names.push_back(u.name);
        std::vector<std::string> parameters;
        for (const model::Parameter& p : model_.parameters) parameters.push_back(p.name);
        for (std::size_t e = 0; e < forms_.size(); ++e) {
            const lumping::LumpedEquation& lumped = lumping_.equations[e];
            equation_index_.push_back(lumped.used ? static_cast<int>(plan_.equations.size()) : -1);
            if (!lumped.used) {
                plan_.notes.push_back("equation '" + model_.equations[e].name + "' has no unknowns and serves simulation alone");
                continue;
            }
            const model::Equation& source = model_.equations[e];
            plan::Equation out;
            out.name = source.name;
            out.ode = source.ode;
            out.n = forms_[e].n;
            out.kappa = source.kappa;
            out.divided = lumped.divided;
            out.leading = text(lumped.leading, parameters);
            out.delayed = forms_[e].delayed;
            for (const lumping::LumpedTerm& term : lumped.terms) {
                const equation::Product& product = forms_[e].terms[static_cast<std::size_t>(term.term)].product;
                Polynomial coefficient = constant(term.known, names.size());
                for (const auto& [unknown, factor] : term.unknown) {
                    Exponents x(names.size(), 0);
                    x[static_cast<std::size_t>(unknown)] = 1;
                    coefficient = sum(coefficient, Polynomial{{x, factor}});
                }
                out.operators.push_back({text(coefficient, names), signal_text(e, product), forms_[e].order(product)});
            }
            out.form = model_.estimator.form;
            out.annihilated = functional_->annihilated(e, rows_);
            plan_.equations.push_back(out);
        }
    }

    /// A product as a signal; the signal under a lone derivative.
    std::string signal_text(std::size_t e, const equation::Product& product) const {
        const OperatorForm& form = forms_[e];
        if (form.order(product) > 0) return model_.signals[static_cast<std::size_t>(form.atoms[static_cast<std::size_t>(product[0].atom)].signal)].name;
        return form.text(product);
    }

    /// The quantities of operating points, computed from the inputs.
    bool quantities(const std::set<int>& used) {
        auto steady = steady_signals(model_, used, diagnostics_);
        if (!steady) return false;
        feed(steady->inputs, {});
        TapeBuilder tape(model_, plan_.scalar, {input_of_signal_});
        for (const plan::Averaged& a : steady->state.averaged) tape.result(tape.signal(model_.signal_index(a.name)));
        steady->state.quantities = tape.finish();
        if (steady->state.stretches >= 0) steady->state.stretches = input_of_signal_[static_cast<std::size_t>(steady->state.stretches)];
        plan_.steady = steady->state;
        input_of_signal_ = steady->index;
        return true;
    }

    bool inputs() {
        std::set<int> used;
        std::set<int> differentiated;
        for (std::size_t e = 0; e < forms_.size(); ++e) {
            if (!lumping_.equations[e].used) continue;
            for (const lumping::LumpedTerm& term : lumping_.equations[e].terms) {
                const equation::Product& product = forms_[e].terms[static_cast<std::size_t>(term.term)].product;
                const bool by_weights = functional_->order(forms_[e], product) > 0;
                for (const equation::Factor& factor : product) {
                    const equation::Atom& atom = forms_[e].atoms[static_cast<std::size_t>(factor.atom)];
                    used.insert(atom.arguments.begin(), atom.arguments.end());
                    if (!by_weights && atom.kind == equation::Atom::Kind::derivative) differentiated.insert(atom.signal);
                    if (atom.differentiates) collect_differentiated(atom.formula, differentiated);
                }
            }
        }
        for (const int s : differentiated) {
            const model::Signal& signal = model_.signals[static_cast<std::size_t>(s)];
            if (!signal.formula) continue;
            diagnostics_.error(model_.path, signal.at, "the parabola filter runs on measured signals, and the derivative of '" + signal.name + "' stands inside a nonlinearity",
                               "measure '" + signal.name + "', or write its derivative by those of measured signals");
            return false;
        }
        if (averages()) return quantities(used);
        feed(measured(model_, used), differentiated);
        return true;
    }

    /// Makes inputs of these signals.
    void feed(const std::set<int>& used, const std::set<int>& differentiated) {
        input_of_signal_.assign(model_.signals.size(), -1);
        const double infinity = std::numeric_limits<double>::infinity();
        for (const int s : used) {
            const model::Signal& signal = model_.signals[static_cast<std::size_t>(s)];
            input_of_signal_[static_cast<std::size_t>(s)] = static_cast<int>(plan_.inputs.size());
            plan_.inputs.push_back({signal.name, signal.unit, signal.column,
                                    signal.min ? exact::nearest(*signal.min, plan_.scalar) : -infinity,
                                    signal.max ? exact::nearest(*signal.max, plan_.scalar) : infinity, differentiated.count(s) > 0});
        }
        int latest = 0;
        for (const int s : used) latest = std::max(latest, model_.signals[static_cast<std::size_t>(s)].lag);
        for (const int s : used) plan_.inputs[static_cast<std::size_t>(input_of_signal_[static_cast<std::size_t>(s)])].wait = latest - model_.signals[static_cast<std::size_t>(s)].lag;
    }

    void collect_differentiated(const formula::Formula& f, std::set<int>& out) const {
        if (formula::is_derivative(f)) out.insert(model_.signal_index(f->arguments[0]->name));
        for (const formula::Formula& a : f->arguments) collect_differentiated(a, out);
    }

    /// Past inputs of every delay in an equation that is used; false after an error.
    bool past_inputs() {
        for (std::size_t e = 0; e < forms_.size(); ++e) {
            if (!lumping_.equations[e].used) continue;
            std::vector<model::Delay> delays;
            for (const lumping::LumpedTerm& term : lumping_.equations[e].terms) {
                for (const equation::Factor& f : forms_[e].terms[static_cast<std::size_t>(term.term)].product) {
                    model::add_delays(model_, forms_[e].atoms[static_cast<std::size_t>(f.atom)].formula, delays);
                }
            }
            for (const model::Delay& d : delays) {
                if (model_.signals[static_cast<std::size_t>(d.signal)].formula) {
                    diagnostics_.error(model_.path, model_.equations[e].place(d.call->start), "a computed signal is delayed", "write the formula with delayed signals in the equation");
                    return false;
                }
                const Rational samples = *d.by / *model_.period;
                if (samples > longest_delay) {
                    diagnostics_.error(model_.path, model_.equations[e].place(d.call->start), "a delay of " + exact::decimal(*d.by) + " s is more than " + std::to_string(longest_delay) + " sampling periods",
                                       "feed the delayed samples as a signal of their own");
                    return false;
                }
                const bool late = forms_[e].delayed;
                delays_[{d.text, late}] = delayed_input(input_of_signal_[static_cast<std::size_t>(d.signal)], cln::cl_I_to_int(cln::floor1(samples)), samples - cln::floor1(samples), late);
            }
        }
        return true;
    }

    /// Between two samples a delayed signal runs straight, whatever its hold: of a held one that is its mean over the period.
    DelayedInput delayed_input(int input, int whole, const Rational& rest, bool late) {
        const int back = whole + (late ? 1 : 0);
        const int newer = past_input(input, back);
        return {plan::Op::input, newer, cln::zerop(rest) ? -1 : past_input(input, back + 1), rest};
    }

    /// Input of the signals' tape.
    int past_input(int input, int samples) {
        if (samples == 0) return input;
        const int inputs = static_cast<int>(plan_.inputs.size());
        for (std::size_t k = 0; k < plan_.past.size(); ++k) {
            if (plan_.past[k].input == input && plan_.past[k].samples == samples) return inputs + static_cast<int>(k);
        }
        plan_.past.push_back({input, samples});
        return inputs + static_cast<int>(plan_.past.size()) - 1;
    }

    int window_signal(std::size_t e, const equation::Product& product, TapeBuilder& tape) {
        const bool by_weights = functional_->order(forms_[e], product) > 0;   // then the ring holds the signal itself
        const bool held_signal = functional_->held(model_, forms_[e], product);
        const plan::Hold hold = held_signal && plan_.decimate == 1 ? plan::Hold::zoh : plan::Hold::linear;   // means move straight from one to the next
        const plan::WindowSignal wanted{by_weights ? signal_text(e, product) : forms_[e].text(product), hold, held_signal, forms_[e].delayed};
        for (std::size_t k = 0; k < plan_.window_signals.size(); ++k) {
            const plan::WindowSignal& s = plan_.window_signals[k];
            if (s.text == wanted.text && s.delayed == wanted.delayed) return static_cast<int>(k);
        }
        plan_.window_signals.push_back(wanted);
        equation::Product undifferentiated = product;
        OperatorForm form = forms_[e];
        if (by_weights) {
            equation::Atom& atom = form.atoms[static_cast<std::size_t>(product[0].atom)];
            atom.formula = atom.formula->arguments[0];
        }
        window_operations_.push_back(tape.product(form, undifferentiated, forms_[e].delayed));
        tape.result(window_operations_.back());
        return static_cast<int>(plan_.window_signals.size()) - 1;
    }

    int table(std::size_t e, int derivative, Kind kind, plan::Hold hold) {
        plan::Table out;
        out.name = functional_->table_name(e, derivative, kind, hold);
        for (std::size_t k = 0; k < plan_.tables.size(); ++k) if (plan_.tables[k].name == out.name) return static_cast<int>(k);
        out.n = forms_[e].n;
        out.kappa = model_.equations[e].kappa;
        out.form = model_.estimator.form;
        out.derivative = derivative;
        out.p = kind.p;
        out.perturbation = kind.perturbation;
        out.hold = hold;
        for (const Rational& c : functional_->kernel(e, derivative, kind)) out.kernel.push_back(exact::text(c));
        equation_of_table_.push_back(e);
        plan_.tables.push_back(std::move(out));
        return static_cast<int>(plan_.tables.size()) - 1;
    }

    void tables_and_rows(const RowWeights& weights) {
        TapeInputs tape_inputs{input_of_signal_};
        tape_inputs.delay = delays_;
        TapeBuilder tape(model_, plan_.scalar, tape_inputs);
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            const std::size_t e = static_cast<std::size_t>(rows_[r].equation);
            plan::Row row{equation_index_[e], rows_[r].p, {}};
            fill(row, e, {row.p, 0}, weights[r], tape);
            plan_.rows.push_back(row);
        }
        for (std::size_t e = 0; e < forms_.size(); ++e) {
            const model::Equation& equation = model_.equations[e];
            if (equation.perturbation.empty() || !lumping_.equations[e].used) continue;
            for (int i = 1; i <= equation.kappa; ++i) {
                plan::Row row{equation_index_[e], 0, {}};
                fill(row, e, {0, i}, functional_->time_scale(i - 1), tape);
                plan_.perturbation.push_back(row);
            }
        }
        plan_.moments = moments(model_, options_.engine, plan_, diagnostics_);
        if (!plan_.moments) weights_and_noise(tape);
        plan_.signals = tape.finish();
    }

    void fill(plan::Row& row, std::size_t e, Kind kind, const Rational& weight, TapeBuilder& tape) {
        std::vector<plan::RowTerm> known;
        for (const lumping::LumpedTerm& term : lumping_.equations[e].terms) {
            for (const auto& [unknown, factor] : term.unknown) row.terms.push_back(row_term(e, kind, term.term, unknown, factor, weight, tape));
            if (!cln::zerop(term.known)) known.push_back(row_term(e, kind, term.term, -1, -term.known, weight, tape));
        }
        std::stable_sort(row.terms.begin(), row.terms.end(), [](const plan::RowTerm& a, const plan::RowTerm& b) { return a.lumped < b.lumped; });
        row.terms.insert(row.terms.end(), known.begin(), known.end());
    }

    /// What reads whole windows, weight by weight.
    void weights_and_noise(TapeBuilder& tape) {
        for (std::size_t k = 0; k < plan_.tables.size(); ++k) {
            plan::Table& t = plan_.tables[k];
            if (options_.weights || t.kernel.empty()) t.weights = functional_->weights(equation_of_table_[k], t.derivative, {t.p, t.perturbation}, t.hold);
        }
        const model::Estimator& e = model_.estimator;
        const bool pooled = e.solve == model::Solver::least_squares || e.solve == model::Solver::elimination;
        if ((pooled && !averages()) || !e.uncertainty.value_or(true)) return;
        if (e.solve == model::Solver::robust && !e.has_window()) return;   // S(t) keeps 32 of its instants for uncertainty(), and these share no samples
        noise_ = noise_channels(model_, input_of_signal_, plan_.past, window_operations_, plan_.scalar, tape);
        plan_.noise = noise_.channels;
        if (pooled && !plan_.noise.empty()) plan_.margin_over_noise = floor_over_noise;
        for (const NoiseChannels::Partial& p : noise_.partials) {
            plan_.partials.push_back("d(" + plan_.window_signals[static_cast<std::size_t>(p.signal)].text + ")/d(" + plan_.tape_input(p.input) + ")");
            tape.result(p.operation);
        }
    }

    plan::RowTerm row_term(std::size_t e, Kind kind, int term, int unknown, const Rational& coefficient, const Rational& weight, TapeBuilder& tape) {
        const equation::Product& product = forms_[e].terms[static_cast<std::size_t>(term)].product;
        const int derivative = functional_->order(forms_[e], product);
        plan::RowTerm out;
        out.lumped = unknown;
        out.derivative = derivative;
        out.coefficient = exact::text(coefficient);
        for (const Rational& c : functional_->kernel(e, derivative, kind)) out.kernel.push_back(exact::text(c * coefficient));
        Rational factor = coefficient * functional_->time_scale(derivative) * weight;
        if (product.empty()) {
            out.signal = -1;
            out.table = -1;
            factor = factor * functional_->of_one(e, derivative, kind);
        } else {
            out.signal = window_signal(e, product, tape);
            out.table = table(e, derivative, kind, plan_.window_signals[static_cast<std::size_t>(out.signal)].hold);
        }
        out.factor = exact::nearest(factor, plan_.scalar);
        return out;
    }

    const model::Model& model_;
    const PlanOptions& options_;
    Diagnostics& diagnostics_;
    std::vector<OperatorForm> forms_;
    lumping::Lumping lumping_;
    std::vector<ChosenRow> rows_;
    std::vector<int> equation_index_;
    std::vector<int> input_of_signal_;
    std::vector<std::size_t> equation_of_table_;
    std::unique_ptr<RowFunctional> functional_;
    std::map<std::pair<std::string, bool>, DelayedInput> delays_;  // by text, and whether the equation is one sample late
    std::vector<int> window_operations_;                           // of the signals' tape, by window signal
    NoiseChannels noise_;
    plan::Plan plan_;
};

}  // namespace

std::optional<std::vector<equation::OperatorForm>> operator_forms(const model::Model& model, Diagnostics& diagnostics) {
    std::vector<equation::OperatorForm> out;
    bool good = true;
    for (const model::Equation& e : model.equations) {
        auto form = equation::operator_form(model, e, diagnostics);
        if (form && model.estimator.functional == model::Functional::average) form = in_steady_state(model, e, *form, diagnostics);
        good = good && form.has_value();
        if (form) out.push_back(*form);
    }
    return good ? std::optional(out) : std::nullopt;
}

std::optional<plan::Plan> plan_of(const model::Model& model, const PlanOptions& options, Diagnostics& diagnostics) {
    auto plan = Planner(model, options, diagnostics).run();
    return diagnostics.failed() ? std::nullopt : plan;
}

}  // namespace algest::generator
