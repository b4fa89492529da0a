// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/normal_form.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "generator/constant_value.hpp"

namespace algest::equation {

using exact::Rational;
using formula::Formula;
using formula::Kind;

namespace {

using Monomial = std::vector<std::pair<int, int>>;
using Sum = std::map<Monomial, Rational>;

Monomial product(const Monomial& a, const Monomial& b) {
    std::map<int, int> powers(a.begin(), a.end());
    for (const auto& [number, power] : b) powers[number] += power;
    Monomial out;
    for (const auto& [number, power] : powers) if (power != 0) out.emplace_back(number, power);
    return out;
}

Monomial raised(Monomial m, int power) {
    for (auto& factor : m) factor.second *= power;
    return m;
}

void add_term(Sum& out, const Monomial& m, const Rational& coefficient) {
    Rational& c = out[m];
    c = c + coefficient;
    if (cln::zerop(c)) out.erase(m);
}

Sum one() { return {{Monomial{}, 1}}; }

/// A sum as coefficient * common factors * what is left; the first coefficient of what is left is positive.
struct Primitive {
    Rational coefficient;
    Monomial common;
    Sum rest;
};

Primitive primitive(const Sum& sum) {
    std::map<int, int> least;   // power of a factor in all terms; 0 where one lacks it
    for (const auto& [m, c] : sum) {
        for (const auto& [number, power] : m) least.emplace(number, std::numeric_limits<int>::max());
    }
    for (auto& [number, power] : least) {
        for (const auto& [m, c] : sum) {
            const auto found = std::find_if(m.begin(), m.end(), [k = number](const auto& f) { return f.first == k; });
            power = std::min(power, found == m.end() ? 0 : found->second);
        }
    }
    Primitive out;
    out.coefficient = content(sum);
    for (const auto& [number, power] : least) if (power != 0) out.common.emplace_back(number, power);
    for (const auto& [m, c] : sum) out.rest.emplace(product(m, raised(out.common, -1)), c / out.coefficient);
    return out;
}

}  // namespace

NormalForm NormalForms::of(const Formula& f) {
    try {
        return numbered(sum_of(f));
    } catch (const TooLarge&) {
        return numbered(factor(formula::text(f)));
    }
}

/// Common factors stay in what is numbered: only a number can be taken out of every function.
NormalForm NormalForms::numbered(const Sum& sum) {
    if (sum.empty()) return {-1, 0};
    const Rational coefficient = content(sum);
    Sum scaled;
    for (const auto& [m, c] : sum) scaled.emplace(m, c / coefficient);
    const int next = static_cast<int>(sums_.size());
    return {sums_.emplace(scaled, next).first->second, coefficient};
}

NormalForms::Sum NormalForms::factor(const std::string& key, const Rational& coefficient) {
    const int next = static_cast<int>(factors_.size());
    return {{Monomial{{factors_.emplace(key, next).first->second, 1}}, coefficient}};
}

NormalForms::Sum NormalForms::sum_of(const Formula& f) {
    Sum out;
    add(out, f, 1);
    return out;
}

void NormalForms::add(Sum& out, const Formula& f, const Rational& factor_of_f) {
    if (const auto value = model::constant_value(model_, f)) {
        if (!cln::zerop(*value)) add_term(out, {}, factor_of_f * *value);
        return;
    }
    const auto add_product = [&](const Sum& a, const Sum& b) {
        if (out.size() + a.size() * b.size() > most_terms) throw TooLarge{};
        for (const auto& [x, c] : a) for (const auto& [y, d] : b) add_term(out, product(x, y), factor_of_f * c * d);
    };
    const auto add_sum = [&](const Sum& sum) { add_product(sum, one()); };
    switch (f->kind) {
        case Kind::number: break;   // has a value
        case Kind::name: return add_sum(factor(f->name));
        case Kind::negate: return add(out, f->arguments[0], -factor_of_f);
        case Kind::add:
        case Kind::subtract:
            add(out, f->arguments[0], factor_of_f);
            return add(out, f->arguments[1], f->kind == Kind::add ? factor_of_f : -factor_of_f);
        case Kind::multiply: return add_product(sum_of(f->arguments[0]), sum_of(f->arguments[1]));
        case Kind::divide: return add_product(sum_of(f->arguments[0]), reciprocal(f->arguments[1], 1));
        case Kind::power: return add_sum(power(f));
        case Kind::call: return add_sum(call(f));
    }
}

NormalForms::Sum NormalForms::power(const Formula& f) {
    const auto exponent = model::constant_value(model_, f->arguments[1]);
    if (!exponent || !exact::is_integer(*exponent) || cln::abs(*exponent) > formula::largest_exponent) {
        return factor("power(" + argument(f->arguments[0]) + "," + argument(f->arguments[1]) + ")");
    }
    const int e = cln::cl_I_to_int(cln::numerator(*exponent));
    if (e < 0) return reciprocal(f->arguments[0], -e);
    const Sum base = sum_of(f->arguments[0]);
    Sum out = one();
    for (int k = 0; k < e; ++k) {
        if (out.size() * base.size() > most_terms) throw TooLarge{};
        Sum next;
        for (const auto& [x, c] : out) for (const auto& [y, d] : base) add_term(next, product(x, y), c * d);
        out = std::move(next);
    }
    return out;
}

NormalForms::Sum NormalForms::reciprocal(const Formula& f, int power) {
    if (f->kind == Kind::multiply) {
        const Sum a = reciprocal(f->arguments[0], power);
        const Sum b = reciprocal(f->arguments[1], power);   // each is one term
        return {{product(a.begin()->first, b.begin()->first), a.begin()->second * b.begin()->second}};
    }
    const Sum below = sum_of(f);
    if (below.empty()) return factor("1/0");
    const Primitive parts = primitive(below);
    Monomial out = raised(parts.common, -power);
    if (parts.rest.size() > 1) {
        const Sum rest = factor("#" + std::to_string(numbered(parts.rest).number));
        out = product(out, raised(rest.begin()->first, -power));
    }
    return {{out, exact::power(parts.coefficient, -power)}};
}

std::string NormalForms::argument(const Formula& f) {
    const NormalForm form = numbered(sum_of(f));
    return exact::text(form.factor) + "*#" + std::to_string(form.number);
}

NormalForms::Sum NormalForms::call(const Formula& f) {
    if (f->name == "der") {
        const std::string order = std::to_string(formula::derivative_order(f));
        return factor("der(" + f->arguments[0]->name + "," + order + ")");
    }
    if (f->name == "delay") return factor("delay(" + f->arguments[0]->name + "," + argument(f->arguments[1]) + ")");
    if (formula::is_function_of_two(f->name)) {   // min and max: in any order
        const std::string a = argument(f->arguments[0]);
        const std::string b = argument(f->arguments[1]);
        return factor(f->name + "(" + std::min(a, b) + "," + std::max(a, b) + ")");
    }
    if (f->name == "sqrt") return factor("power(" + argument(f->arguments[0]) + ",1/2*#" + std::to_string(numbered(one()).number) + ")");
    const NormalForm inside = numbered(sum_of(f->arguments[0]));
    const std::string form = "#" + std::to_string(inside.number);
    const Rational size = cln::abs(inside.factor);
    const Rational sign = cln::signum(inside.factor);
    if (f->name == "abs") return cln::zerop(size) ? Sum() : factor("abs(" + form + ")", size);
    if (f->name == "sgn") return cln::zerop(size) ? Sum() : factor("sgn(" + form + ")", sign);
    if (f->name == "cos") return factor("cos(" + exact::text(size) + "*" + form + ")");
    if (f->name == "sin" || f->name == "tan") return cln::zerop(size) ? Sum() : factor(f->name + "(" + exact::text(size) + "*" + form + ")", sign);
    return factor(f->name + "(" + exact::text(inside.factor) + "*" + form + ")");
}

}  // namespace algest::equation
