// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/plan_parameters.hpp"

#include <limits>

#include "generator/dimension.hpp"
#include "generator/equation_unit.hpp"
#include "generator/initial_value.hpp"
#include "generator/tape_builder.hpp"
#include "generator/tidy_unit.hpp"
#include "generator/units.hpp"

namespace algest::generator {

namespace {

/// At the initial values of the parameters, rounded once; NaN where it has none.
double initial_value(const Quotient& q, const model::Model& model, plan::Scalar scalar) {
    const auto value = model::at_initial(q, model);
    return value ? exact::nearest(*value, scalar) : std::numeric_limits<double>::quiet_NaN();
}

/// The rows were divided by the leading coefficient: what they say of a perturbation is multiplied by it.
void perturbations(const model::Model& model, const lumping::Lumping& lumping, plan::Plan& plan, TapeBuilder& map, const std::vector<int>& operations) {
    int residual = static_cast<int>(plan.lumped.size());
    for (std::size_t e = 0; e < model.equations.size(); ++e) {
        const model::Equation& equation = model.equations[e];
        const lumping::LumpedEquation& lumped = lumping.equations[e];
        if (equation.perturbation.empty() || !lumped.used) continue;
        const std::string unit = model::unit_of_equation(model, equation).known() ? model::equation_unit(model, equation) : "";
        for (int i = 1; i <= equation.kappa; ++i, ++residual) {
            const int leading = map.quotient(lumped.leading, operations);
            const int coefficient = map.input(residual);
            map.result(lumped.divided ? map.times(coefficient, leading) : coefficient);
            const std::string name = equation.kappa == 1 ? equation.perturbation : equation.perturbation + std::to_string(i);
            const std::string power = i == 1 ? "1" : i == 2 ? "t" : "t^" + std::to_string(i - 1) + "/" + std::to_string(i - 1) + "!";
            const std::string what = equation.kappa == 1 ? "constant perturbation of '" + equation.name + "' on the window"
                                                         : "coefficient of " + power + " in the perturbation of '" + equation.name + "', t from the oldest sample of the window on";
            plan.parameters.push_back({name, i == 1 || unit.empty() ? unit : units::tidy("(" + unit + ")/s^" + std::to_string(i - 1)), what, 0.0, true});
        }
    }
}

void elimination(const lumping::Lumping& lumping, plan::Plan& plan) {
    plan.elimination = lumping.elimination;
    if (!plan.elimination) return;
    const auto round = [&](auto& terms) {
        for (auto& term : terms) term.coefficient = exact::nearest(exact::from_text(term.exact), plan.scalar);
    };
    for (plan::EliminationStage& stage : plan.elimination->stages) {
        round(stage.alone);
        round(stage.summands);
    }
    if (plan.scalar == plan::Scalar::float32) plan.notes.emplace_back("single precision does not hold the coefficients of a resultant, nor the products of signals of different sizes: use double");
}

void derivatives_of_the_map(const model::Model& model, const lumping::Lumping& lumping, plan::Plan& plan) {
    TapeBuilder map(model, plan.scalar, {});
    const int n = static_cast<int>(plan.lumped.size());
    std::vector<int> operations;
    for (const auto& inverse : lumping.inverse) if (inverse) operations.push_back(map.quotient(*inverse));
    for (const int o : operations) for (int u = 0; u < n; ++u) map.result_or_zero(map.partial(o, plan::Op::input, u));
    for (const int o : operations) {
        for (int u = 0; u < n; ++u) {
            const int slope = map.partial(o, plan::Op::input, u);
            for (int v = u; v < n; ++v) map.result_or_zero(slope < 0 ? -1 : map.partial(slope, plan::Op::input, v));
        }
    }
    plan.map_derivatives = map.finish();
}

}  // namespace

void plan_parameters(const model::Model& model, const lumping::Lumping& lumping, plan::Plan& plan) {
    std::vector<std::string> parameters;
    for (const model::Parameter& p : model.parameters) parameters.push_back(p.name);
    std::vector<std::string> unknowns;
    for (const lumping::Unknown& u : lumping.unknowns) {
        unknowns.push_back(u.name);
        plan.lumped.push_back({u.name, text(u.meaning, parameters), initial_value(u.meaning, model, plan.scalar)});
    }
    TapeBuilder map(model, plan.scalar, {});
    std::vector<int> operations(model.parameters.size(), -1);
    for (std::size_t k = 0; k < model.parameters.size(); ++k) {
        const model::Parameter& p = model.parameters[k];
        if (lumping.elimination) {
            plan.parameters.push_back({p.name, p.unit, p.name, p.initial ? exact::nearest(*p.initial, plan.scalar) : 0.0, false});
            map.result(map.input(static_cast<int>(k)));
        }
        if (!lumping.inverse[k]) continue;
        plan.parameters.push_back({p.name, p.unit, text(*lumping.inverse[k], unknowns), p.initial ? exact::nearest(*p.initial, plan.scalar) : 0.0, false});
        operations[k] = map.quotient(*lumping.inverse[k]);
        map.result(operations[k]);
    }
    perturbations(model, lumping, plan, map, operations);
    plan.parameter_map = map.finish();
    elimination(lumping, plan);
    if ((plan.uncertain() && !plan.elimination) || plan.solve == algest::Solve::least_squares) derivatives_of_the_map(model, lumping, plan);
}

}  // namespace algest::generator
