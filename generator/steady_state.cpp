// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/steady_state.hpp"

#include <algorithm>
#include <limits>

#include "generator/delay.hpp"
#include "generator/suggestion.hpp"

namespace algest::generator {

namespace {

using equation::Atom;
using equation::OperatorForm;
using equation::Term;

void collect_signals(const model::Model& model, const formula::Formula& f, std::set<int>& out) {
    if (f->kind == formula::Kind::name && model.signal_index(f->name) >= 0) out.insert(model.signal_index(f->name));
    for (const formula::Formula& a : f->arguments) collect_signals(model, a, out);
}

/// What of the equation's keys has no meaning for averages; empty: nothing.
std::string meaningless_key(const model::Equation& equation) {
    if (equation.kappa > 0) return "kappa";
    if (equation.rows.count.value_or(1) != 1 || (!equation.rows.list.empty() && equation.rows.list != std::vector<int>{1})) return "rows";
    return "";
}

}  // namespace

std::optional<OperatorForm> in_steady_state(const model::Model& model, const model::Equation& equation, OperatorForm form, Diagnostics& diagnostics) {
    const auto refuse = [&](const std::string& what, const std::string& right) {
        diagnostics.error(model.path, equation.at, what, right);
        return std::nullopt;
    };
    if (const std::string key = meaningless_key(equation); !key.empty()) {
        return refuse("equation '" + equation.name + "' asks for " + key + ", and an operating point gives one mean of it", "leave it out with functional = \"average\"");
    }
    std::vector<model::Delay> delays;
    for (const formula::Formula& side : {equation.sides.left, equation.sides.right}) model::add_delays(model, side, delays);
    if (!delays.empty()) return refuse("a delay in equation '" + equation.name + "': in a steady state a delayed signal is the signal", "write it without delay()");
    const auto atom = [&](const equation::Factor& factor) -> const Atom& { return form.atoms[static_cast<std::size_t>(factor.atom)]; };
    for (const Term& term : form.terms) {
        for (const equation::Factor& factor : term.product) {
            const bool below = atom(factor).kind == Atom::Kind::derivative && factor.power < 0;
            if (atom(factor).differentiates || below) return refuse("a derivative in '" + atom(factor).text + "', which has no mean in a steady state", "write the equation of the steady state");
        }
    }
    const auto moves = [&](const Term& term) {
        return std::any_of(term.product.begin(), term.product.end(), [&](const equation::Factor& f) { return atom(f).kind == Atom::Kind::derivative; });
    };
    form.terms.erase(std::remove_if(form.terms.begin(), form.terms.end(), moves), form.terms.end());
    if (form.terms.empty()) return refuse("every term of equation '" + equation.name + "' holds a derivative: a steady state says nothing of it", "use functional = \"annihilator\" for it, in a model of its own");
    form.n = 0;
    form.leading = -1;
    form.delayed = false;
    return form;
}

std::set<int> measured(const model::Model& model, const std::set<int>& signals) {
    std::set<int> out;
    for (const int s : signals) {
        const model::Signal& signal = model.signals[static_cast<std::size_t>(s)];
        if (signal.formula) collect_signals(model, signal.formula, out);
        else out.insert(s);
    }
    return out;
}

std::optional<SteadySignals> steady_signals(const model::Model& model, const std::set<int>& used, Diagnostics& diagnostics) {
    SteadySignals out{{cln::cl_I_to_int(cln::floor1(*model.window / *model.period)), {}, {}, -1}, std::vector<int>(model.signals.size(), -1), {}};
    std::set<int> averaged = used;
    for (std::size_t s = 0; s < model.signals.size(); ++s) if (model.signals[s].steady) averaged.insert(static_cast<int>(s));
    for (const int s : averaged) {
        const model::Signal& signal = model.signals[static_cast<std::size_t>(s)];
        out.index[static_cast<std::size_t>(s)] = static_cast<int>(out.state.averaged.size());
        const double tolerance = signal.steady ? exact::nearest(*signal.steady, plan::Scalar::float64) : std::numeric_limits<double>::infinity();
        out.state.averaged.push_back({signal.name, signal.unit, tolerance});
    }
    out.inputs = measured(model, averaged);
    const model::Mention& stretches = model.estimator.stretches;
    if (stretches.name.empty()) return out;
    const int marker = model.signal_index(stretches.name);
    if (marker < 0 || model.signals[static_cast<std::size_t>(marker)].formula) {
        diagnostics.error(model.path, stretches.at, "'" + stretches.name + "' is no measured signal", did_you_mean(stretches.name, model::signal_names(model)) + "declare it under [signals]: 0 outside, another number in each stretch");
        return std::nullopt;
    }
    out.inputs.insert(marker);
    out.state.stretches = marker;   // by the model's signals; the plan numbers its inputs
    return out;
}

}  // namespace algest::generator
