// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/held_parameters.hpp"

#include <set>

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

/// Parameters inside of functions, powers and denominators.
void collect_nonlinear(const Formula& f, const model::Model& model, bool inside, std::set<std::string>& out) {
    if (f->kind == Kind::name && inside && model.parameter(f->name) != nullptr) out.insert(f->name);
    const bool bends = f->kind == Kind::power || (f->kind == Kind::call && f->name != "der");
    for (std::size_t k = 0; k < f->arguments.size(); ++k) collect_nonlinear(f->arguments[k], model, inside || bends || (f->kind == Kind::divide && k == 1), out);
}

Formula with_values(const Formula& f, const model::Model& model, const std::set<std::string>& held) {
    formula::Node node = *f;
    if (f->kind == Kind::name && held.count(f->name) > 0) {
        node.kind = Kind::number;
        node.value = *model.parameter(f->name)->initial;
    }
    for (Formula& a : node.arguments) a = with_values(a, model, held);
    return std::make_shared<const formula::Node>(std::move(node));
}

}  // namespace

std::optional<equation::OperatorForm> form_with_held_parameters(const model::Model& model, std::size_t index) {
    Diagnostics quiet;
    const model::Equation& equation = model.equations[index];
    if (auto form = equation::operator_form(model, equation, quiet)) return form;
    std::set<std::string> held;
    collect_nonlinear(equation.sides.left, model, false, held);
    collect_nonlinear(equation.sides.right, model, false, held);
    for (const std::string& name : held) if (!model.parameter(name)->initial) return std::nullopt;
    model::Equation plain = equation;
    plain.sides = {with_values(equation.sides.left, model, held), with_values(equation.sides.right, model, held)};
    return held.empty() ? std::nullopt : equation::operator_form(model, plain, quiet);
}

}  // namespace algest::lab
