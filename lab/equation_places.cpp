// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/equation_places.hpp"

#include <algorithm>

#include "lab/roles.hpp"

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

/// Every node outside of der(), the calls of der() themselves included.
template <class Use>
void each_outside(const Formula& f, Use use) {
    use(f);
    if (formula::is_derivative(f)) return;
    for (const Formula& a : f->arguments) each_outside(a, use);
}

template <class Use>
void each_outside(const model::Equation& e, Use use) {
    each_outside(e.sides.left, use);
    each_outside(e.sides.right, use);
}

Stretch stretch_of_name(const Formula& name) {
    const auto begin = static_cast<std::size_t>(name->offset);
    return {begin, begin + name->name.size()};
}

/// Up to the parenthesis that closes the call.
Stretch stretch_of_call(const Formula& call, const std::string& ode) {
    const auto begin = static_cast<std::size_t>(call->offset);
    int open = 0;
    for (std::size_t at = begin; at < ode.size(); ++at) {
        if (ode[at] == '(') ++open;
        else if (ode[at] == ')' && --open == 0) return {begin, at + 1};
    }
    return {begin, ode.size()};
}

/// True for a - b where both are bare names, so that its text is that from a to b.
bool is_plain_difference(const Formula& f) {
    if (f->kind != Kind::subtract) return false;
    const auto bare = [](const Formula& a) { return a->kind == Kind::name && a->start == a->offset; };
    return bare(f->arguments[0]) && bare(f->arguments[1]);
}

/// The summands of a side, without their signs.
void collect_terms(const Formula& f, std::vector<Formula>& out) {
    if (f->kind == Kind::add || f->kind == Kind::subtract || f->kind == Kind::negate) {
        for (const Formula& a : f->arguments) collect_terms(a, out);
    } else {
        out.push_back(f);
    }
}

/// The factors of a product; a quotient is one factor.
void collect_factors(const Formula& f, std::vector<Formula>& out) {
    if (f->kind == Kind::multiply) {
        for (const Formula& a : f->arguments) collect_factors(a, out);
    } else {
        out.push_back(f);
    }
}

std::vector<std::vector<Formula>> products(const model::Equation& e) {
    std::vector<Formula> terms;
    collect_terms(e.sides.left, terms);
    collect_terms(e.sides.right, terms);
    std::vector<std::vector<Formula>> out;
    for (const Formula& t : terms) {
        out.emplace_back();
        collect_factors(t, out.back());
    }
    return out;
}

bool is_quantity(const model::Model& model, const Formula& f) {
    return f->kind == Kind::name && (model.parameter(f->name) != nullptr || model.constant(f->name) != nullptr);
}

/// Parameters and constants that stand in a product with one other factor, of which `wanted` is true.
template <class Wanted>
std::vector<std::string> quantities_beside(const model::Model& model, const model::Equation& e, Wanted wanted) {
    std::vector<std::string> out;
    for (const auto& factors : products(e)) {
        if (factors.size() != 2) continue;
        for (const std::size_t k : {0U, 1U}) if (is_quantity(model, factors[k]) && wanted(factors[1 - k])) out.push_back(factors[k]->name);
    }
    return out;
}

}  // namespace

std::vector<Stretch> places_of_name(const model::Equation& e, const std::string& name) {
    std::vector<Stretch> out;
    each_outside(e, [&](const Formula& f) { if (f->kind == Kind::name && f->name == name) out.push_back(stretch_of_name(f)); });
    return out;
}

std::vector<Stretch> places_of_derivative(const model::Equation& e, const std::string& signal) {
    std::vector<Stretch> out;
    each_outside(e, [&](const Formula& f) { if (formula::is_derivative(f) && f->arguments[0]->name == signal) out.push_back(stretch_of_call(f, e.ode)); });
    return out;
}

std::vector<Stretch> places_of_difference(const model::Equation& e, const std::string& a, const std::string& b) {
    std::vector<Stretch> out;
    each_outside(e, [&](const Formula& f) {
        if (!is_plain_difference(f)) return;
        const std::string& left = f->arguments[0]->name;
        const std::string& right = f->arguments[1]->name;
        if ((left == a && right == b) || (left == b && right == a)) out.push_back({stretch_of_name(f->arguments[0]).begin, stretch_of_name(f->arguments[1]).end});
    });
    return out;
}

std::vector<Stretch> places_of_difference_of_rates(const model::Equation& e, const std::string& a, const std::string& b) {
    std::vector<Stretch> out;
    const auto is_rate = [](const Formula& f, const std::string& x) { return formula::is_derivative(f) && formula::derivative_order(f) == 1 && f->start == f->offset && f->arguments[0]->name == x; };
    each_outside(e, [&](const Formula& f) {
        if (f->kind != Kind::subtract) return;
        const Formula& left = f->arguments[0];
        const Formula& right = f->arguments[1];
        if ((is_rate(left, a) && is_rate(right, b)) || (is_rate(left, b) && is_rate(right, a))) out.push_back({stretch_of_call(left, e.ode).begin, stretch_of_call(right, e.ode).end});
    });
    return out;
}

std::vector<Stretch> place_of_leading(const model::Model& model, const model::Equation& e) {
    const Moved own = moved(model, e);
    std::vector<Stretch> out;
    for (const auto& factors : products(e)) {
        const bool leads = std::any_of(factors.begin(), factors.end(), [&](const Formula& f) {
            if (!formula::is_derivative(f) || model.signal_index(f->arguments[0]->name) != own.signal) return false;
            return formula::derivative_order(f) == own.order;
        });
        if (!leads || factors.size() != 2) continue;
        for (const Formula& f : factors) if (is_quantity(model, f)) out.push_back(stretch_of_name(f));
    }
    return out.size() == 1 ? out : std::vector<Stretch>();
}

std::vector<std::string> factors_of_signal(const model::Model& model, const model::Equation& e, const std::string& signal) {
    return quantities_beside(model, e, [&](const Formula& f) { return f->kind == Kind::name && f->name == signal; });
}

std::vector<std::string> factors_of_sign(const model::Model& model, const model::Equation& e, const std::string& signal, bool of_its_rate) {
    return quantities_beside(model, e, [&](const Formula& f) {
        if (!formula::is_call(f, "sgn")) return false;
        const Formula& speed = f->arguments[0];
        if (of_its_rate) return formula::is_derivative(speed) && formula::derivative_order(speed) == 1 && speed->arguments[0]->name == signal;
        return speed->kind == Kind::name && speed->name == signal;
    });
}

std::vector<std::pair<std::string, std::string>> differences(const model::Model& model, const model::Equation& e) {
    std::vector<std::pair<std::string, std::string>> out;
    each_outside(e, [&](const Formula& f) {
        if (!is_plain_difference(f)) return;
        const std::string& a = f->arguments[0]->name;
        const std::string& b = f->arguments[1]->name;
        if (model.signal(a) == nullptr || model.signal(b) == nullptr) return;
        const std::pair<std::string, std::string> pair = {std::min(a, b), std::max(a, b)};
        if (std::find(out.begin(), out.end(), pair) == out.end()) out.push_back(pair);
    });
    return out;
}

}  // namespace algest::lab
