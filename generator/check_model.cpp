// SPDX-License-Identifier: GPL-3.0-or-later
// A model file is sound where an estimator follows from it, or where it is said why none does and simulation alone is served.
#include "generator/generate.hpp"
#include "generator/lumping.hpp"
#include "generator/planner.hpp"
#include "generator/row_choice.hpp"

namespace algest::generator {

namespace {

/// True, with a warning for each, where parameters enter nonlinearly; what else keeps an equation from its form is an error.
bool simulation_alone(const model::Model& model, Diagnostics& diagnostics) {
    bool out = false;
    for (const model::Equation& e : model.equations) {
        const auto p = equation::nonlinear_parameter(model, e);
        if (!p) continue;
        diagnostics.warning(e.file, p->at, "parameter '" + p->name + "' stands " + p->where + ": simulate and discover fit it, an estimator cannot",
                            "declare it under [constants] once its value is known");
        out = true;
    }
    for (const model::Equation& e : model.equations) if (out && !equation::nonlinear_parameter(model, e)) (void)equation::operator_form(model, e, diagnostics);
    return out;
}

}  // namespace

bool check_model(const std::string& path, bool strict, Diagnostics& diagnostics) {
    const auto model = model::read(path, strict, diagnostics);
    if (!model) return false;
    if (model->filter || simulation_alone(*model, diagnostics)) return !diagnostics.failed();
    if (model->discrete || (!model->parameters.empty() && model->period && (model->window || !model->estimator.has_window()))) {   // an estimator follows, or it is said why not
        PlanOptions options;
        options.weights = false;
        (void)plan_of(*model, options, diagnostics);
        return !diagnostics.failed();
    }
    const auto forms = operator_forms(*model, diagnostics);
    if (!forms) return false;
    const auto lumping = lumping::lump(*model, *forms, diagnostics);
    if (!lumping) return false;
    if (!model->parameters.empty()) {
        (void)choose_rows(*model, *lumping, diagnostics);
        diagnostics.note(path, "sound; without [sampling] period and window it serves simulation, an estimator needs both");
    }
    return !diagnostics.failed();
}

}  // namespace algest::generator
