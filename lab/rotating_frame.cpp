// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/rotating_frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "generator/equation.hpp"
#include "lab/polynomial_value.hpp"
#include "lab/roles.hpp"

namespace algest::lab {

namespace {

/// c of the term  c*speed*current  over that of the leading derivative; 0: there is no such term.
struct Coupling {
    int speed = -1;
    double factor = 0;
};

Coupling coupling(const equation::OperatorForm& form, int current, const std::vector<double>& parameters) {
    const auto signal = [&](const equation::Factor& f) {
        const equation::Atom& a = form.atoms[static_cast<std::size_t>(f.atom)];
        return a.kind == equation::Atom::Kind::signal && f.power == 1 ? a.signal : -1;
    };
    const double leading = value_of(form.terms[static_cast<std::size_t>(form.leading)].coefficient, parameters);
    for (const equation::Term& t : form.terms) {
        if (t.product.size() != 2) continue;
        const int a = signal(t.product[0]);
        const int b = signal(t.product[1]);
        if (a < 0 || b < 0 || (a != current && b != current)) continue;
        return {a == current ? b : a, value_of(t.coefficient, parameters) / leading};
    }
    return {};
}

/// The constant without a dimension that has this value, else the number.
std::string number_text(const model::Model& model, double value) {
    for (const model::Constant& c : model.constants) if (fits(units::Unit::parse(c.unit).value_or(units::Unit()), "1") && std::abs(exact::nearest(c.value, plan::Scalar::float64) - value) < 1e-9 * std::abs(value)) return c.name;
    return fmt::format("{:.6g}", value);
}

}  // namespace

std::optional<RotatingFrame> rotating_frame(const model::Model& model, const std::vector<bool>& measured) {
    std::vector<double> parameters;
    for (const model::Parameter& p : model.parameters) parameters.push_back(p.initial ? exact::nearest(*p.initial, plan::Scalar::float64) : 1.0);
    std::vector<std::optional<equation::OperatorForm>> forms;
    Diagnostics quiet;
    for (const model::Equation& e : model.equations) {
        const Moved own = moved(model, e);
        const bool electrical = own.signal >= 0 && fits(units::Unit::parse(model.signals[static_cast<std::size_t>(own.signal)].unit).value_or(units::Unit()), "A");
        forms.push_back(electrical ? equation::operator_form(model, e, quiet) : std::nullopt);
        if (forms.back() && forms.back()->leading < 0) forms.back().reset();
    }
    for (std::size_t d = 0; d < forms.size(); ++d) {
        for (std::size_t q = 0; q < forms.size(); ++q) {
            if (d == q || !forms[d] || !forms[q]) continue;
            const int i_d = moved(model, model.equations[d]).signal;
            const int i_q = moved(model, model.equations[q]).signal;
            const Coupling in_d = coupling(*forms[d], i_q, parameters);
            const Coupling in_q = coupling(*forms[q], i_d, parameters);
            if (in_d.speed < 0 || in_d.speed != in_q.speed || !(in_d.factor < 0) || !(in_q.factor > 0)) continue;
            const int angle = integral_of(model, in_d.speed);
            if (angle < 0 || !measured[static_cast<std::size_t>(angle)]) return std::nullopt;
            const double pairs = std::sqrt(-in_d.factor * in_q.factor);   // of L_q/L_d and L_d/L_q: the inductances cancel
            const auto name = [&](int s) { return model.signals[static_cast<std::size_t>(s)].name; };
            const std::string count = number_text(model, pairs);
            return RotatingFrame{d, q, name(i_d), name(i_q), std::abs(pairs - 1) < 1e-9 ? name(angle) : count + "*" + name(angle), name(in_d.speed), count};
        }
    }
    return std::nullopt;
}

}  // namespace algest::lab
