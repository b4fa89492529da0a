// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/plan_solver.hpp"

#include <fmt/format.h>

#include "generator/low_pass.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

/// Rows of a machine that is excited well have a condition of 10 to 1e4; beyond 1e5 they tell noise and rounding apart no more.
/// Single precision stops where rounding alone would cost three digits of seven; S(t) squares the condition of its rows.
double default_condition_limit(const model::Model& model, plan::Scalar scalar, algest::Solve solve) {
    if (model.discrete) return scalar == plan::Scalar::float64 ? 1e14 : 1e9;
    if (scalar == plan::Scalar::float64) return 1e5;
    return solve == algest::Solve::robust ? 92.0 : 8.4e3;   // sqrt(1e-3 / epsilon), 1e-3 / epsilon
}

}  // namespace

void plan_solver(const model::Model& model, plan::Plan& plan) {
    const model::Estimator& e = model.estimator;
    plan.solve = e.solve == model::Solver::robust          ? algest::Solve::robust
                  : e.solve == model::Solver::least_squares ? algest::Solve::least_squares
                  : e.solve == model::Solver::elimination ? algest::Solve::elimination
                                                            : algest::Solve::square;
    plan.solve_instants = 0;
    if (plan.solve == algest::Solve::robust) {
        const Rational window = e.solve_window ? *e.solve_window : *model.window;
        if (!e.solve_window) plan.notes.push_back("no solve_window: S(t) runs over one window");
        plan.solve_instants = cln::cl_I_to_int(cln::floor1(window / model.window_period())) + 1;
    }
    plan.keep = e.forgetting == 1 ? 1.0 : exact::nearest(*exact::function_value("sqrt", e.forgetting), plan.scalar);
    plan.deviation_limit = e.deviation_limit ? exact::nearest(*e.deviation_limit, plan.scalar) : 0.0;
    plan.whiten = e.whiten;
    if (e.omega_n) {
        const low_pass::Discrete filter = low_pass::discretised(*e.omega_n * *model.period, e.zeta);
        const auto rounded = [&](const auto& numbers) {
            std::vector<double> out;
            for (const Rational& x : numbers) out.push_back(exact::nearest(x, plan.scalar));
            return out;
        };
        plan.ratio = {exact::text(*e.omega_n), exact::text(e.zeta), rounded(filter.transition), rounded(filter.before), rounded(filter.now)};
    }
    const double standard = default_condition_limit(model, plan.scalar, plan.solve);
    plan.condition_limit = e.condition_limit ? exact::nearest(*e.condition_limit, plan.scalar) : standard;
    if (plan.solve == algest::Solve::robust && plan.scalar == plan::Scalar::float32 && !e.condition_limit) {
        plan.notes.push_back(fmt::format("in single precision solve = \"robust\" calls every estimate with a condition above {:.0f} singular, since its sums square it, and a machine that is excited well has 10 to 1e4: "
                                         "count them with algest replay MODEL RECORDING --scalar float, and take solve = \"square\" ({:.0f}), a condition_limit of your own, or double where they are many",
                                         standard, default_condition_limit(model, plan.scalar, algest::Solve::square)));
    }
}

}  // namespace algest::generator
