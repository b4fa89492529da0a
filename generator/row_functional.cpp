// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/row_functional.hpp"

#include <stdexcept>

#include "generator/steady_state.hpp"

namespace algest::generator {

bool RowFunctional::held(const model::Model& model, const equation::OperatorForm& form, const equation::Product& product) const {
    for (const equation::Factor& factor : product) {
        const equation::Atom& atom = form.atoms[static_cast<std::size_t>(factor.atom)];
        const bool filtered = atom.differentiates || (atom.kind == equation::Atom::Kind::derivative && order(form, product) == 0);
        if (filtered) return false;
        for (const int s : measured(model, {atom.arguments.begin(), atom.arguments.end()})) if (model.signals[static_cast<std::size_t>(s)].hold != plan::Hold::zoh) return false;
    }
    return true;
}

std::unique_ptr<RowFunctional> row_functional(const model::Model& model, const std::vector<equation::OperatorForm>& forms, plan::Scalar scalar) {
    switch (model.estimator.functional) {
        case model::Functional::annihilator: return annihilator_functional(model, forms, scalar);
        case model::Functional::derivative: return derivative_functional(model, forms);
        case model::Functional::average: return average_functional();
        case model::Functional::discrete: break;
    }
    throw std::logic_error("a functional that the model's reader refuses");
}

}  // namespace algest::generator
