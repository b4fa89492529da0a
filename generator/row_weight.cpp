// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/row_weight.hpp"

#include <algorithm>

#include "generator/dimension.hpp"
#include "generator/initial_value.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

/// Standard deviation of the residual's largest part, in the unit of the equation as the rows use it.
std::optional<Rational> noise_of(const model::Model& model, const equation::OperatorForm& form, const lumping::LumpedEquation& lumped, const RowFunctional& functional) {
    if (form.leading < 0) return std::nullopt;
    const equation::Term& term = form.terms[static_cast<std::size_t>(form.leading)];
    const model::Signal& signal = model.signals[static_cast<std::size_t>(form.atoms[static_cast<std::size_t>(term.product[0].atom)].signal)];
    const std::optional<Rational> sigma = signal.deviation();
    if (!sigma) return std::nullopt;
    const auto coefficient = lumped.divided ? std::optional<Rational>(1) : model::at_initial(term.coefficient, model);
    if (!coefficient || cln::zerop(*coefficient)) return std::nullopt;
    return *sigma * cln::abs(*coefficient) * functional.noise_gain(form.n);
}

/// The unit of the equation's rows: divided, it is that of its highest derivative.
units::Unit unit_of_rows(const model::Model& model, std::size_t e, const equation::OperatorForm& form, const lumping::LumpedEquation& lumped) {
    if (!lumped.divided) return model::unit_of_equation(model, model.equations[e]);
    if (form.leading < 0) return {};   // divided by the coefficient of a product
    const equation::Term& term = form.terms[static_cast<std::size_t>(form.leading)];
    const std::string& unit = model.signals[static_cast<std::size_t>(form.atoms[static_cast<std::size_t>(term.product[0].atom)].signal)].unit;
    return unit.empty() ? units::Unit() : units::Unit::parse(unit)->over(units::Unit::parse("s")->power(form.n));
}

/// The written scale, in the unit of the equation as the rows use it: divided like the equation.
std::optional<Rational> scale_of(const model::Model& model, std::size_t e, const lumping::LumpedEquation& lumped) {
    if (!model.equations[e].scale) return std::nullopt;
    const auto leading = model::at_initial(lumped.leading.numerator, model);
    if (!leading || cln::zerop(*leading)) return std::nullopt;
    return *model.equations[e].scale / cln::abs(*leading);
}

}  // namespace

std::optional<RowWeights> row_weights(const model::Model& model, const std::vector<equation::OperatorForm>& forms,
                                      const lumping::Lumping& lumping, const std::vector<ChosenRow>& rows, RowFunctional& functional,
                                      Diagnostics& diagnostics) {
    if (model.estimator.solve == model::Solver::square && rows.size() == lumping.unknowns.size()) return RowWeights(rows.size(), 1);

    const std::size_t equations = model.equations.size();
    std::vector<Rational> size(equations, 1);
    for (std::size_t e = 0; e < equations; ++e) {
        if (!lumping.equations[e].used) continue;
        std::vector<std::size_t> group;
        for (std::size_t other = 0; other < equations; ++other) {
            if (lumping.equations[other].used && lumping.equations[other].component == lumping.equations[e].component) group.push_back(other);
        }
        if (group.size() == 1) continue;
        bool mixed = false;
        bool all_noisy = true;
        bool all_scaled = true;
        for (const std::size_t other : group) {
            const units::Unit mine = unit_of_rows(model, e, forms[e], lumping.equations[e]);
            const units::Unit theirs = unit_of_rows(model, other, forms[other], lumping.equations[other]);
            mixed = mixed || (mine.known() && theirs.known() && !mine.same_dimension(theirs));
            all_noisy = all_noisy && noise_of(model, forms[other], lumping.equations[other], functional).has_value();
            all_scaled = all_scaled && scale_of(model, other, lumping.equations[other]).has_value();
        }
        if (all_noisy) {
            size[e] = *noise_of(model, forms[e], lumping.equations[e], functional);
        } else if (all_scaled) {
            size[e] = *scale_of(model, e, lumping.equations[e]);
        } else if (mixed) {
            diagnostics.error(model.path, model.equations[e].at, "equation '" + model.equations[e].name + "' is pooled with equations of other units, and nothing says how they compare",
                              "declare noise = ... for the signals with the highest derivatives, or scale = ... in each equation, and initial = ... for the parameters of the leading coefficients");
            return std::nullopt;
        }
    }
    RowWeights out;
    for (const ChosenRow& row : rows) {
        const std::size_t e = static_cast<std::size_t>(row.equation);
        const Rational norm2 = functional.square_norm(e, row.p);
        out.push_back(1 / exact::power_of_two_near_root(norm2 * size[e] * size[e]));
    }
    return out;
}

}  // namespace algest::generator
