// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/tape_builder.hpp"

#include <stdexcept>

#include "generator/constant_value.hpp"

namespace algest {

using exact::Rational;
using formula::Kind;
using plan::Op;

namespace {

Op op_of_function(const std::string& name) {
    static const std::map<std::string, Op> ops = {{"sin", Op::sin}, {"cos", Op::cos}, {"tan", Op::tan}, {"exp", Op::exp}, {"log", Op::log},
                                                  {"sqrt", Op::sqrt}, {"abs", Op::abs}, {"sgn", Op::sgn}, {"min", Op::min}, {"max", Op::max}};
    return ops.at(name);
}

bool reads_input(Op op) { return op == Op::input || op == Op::previous || op == Op::derivative; }

}  // namespace

int TapeBuilder::constant(const Rational& value) {
    for (const auto& [v, k] : constants_) if (v == value) return k;
    entries_.push_back({Op::constant, -1, -1, value});
    constants_.emplace_back(value, static_cast<int>(entries_.size()) - 1);
    return constants_.back().second;
}

int TapeBuilder::add(Op op, int a, int b) {
    if (op == Op::mul && is_constant(a) && value(a) == 1) return b;
    if ((op == Op::mul || op == Op::div) && is_constant(b) && value(b) == 1) return a;
    const auto key = std::make_tuple(op, a, b);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    entries_.push_back({op, a, b, 0});
    return known_[key] = static_cast<int>(entries_.size()) - 1;
}

int TapeBuilder::power(int base, int exponent) {
    if (exponent == 0) return constant(1);
    if (exponent < 0) {
        const int one = constant(1);   // first: operations are numbered in the order in which they are made
        return add(Op::div, one, power(base, -exponent));
    }
    int out = -1;
    int square = base;
    for (int rest = exponent; rest > 0; rest /= 2) {
        if (rest % 2 == 1) out = out < 0 ? square : add(Op::mul, out, square);
        if (rest > 1) square = add(Op::mul, square, square);
    }
    return out;
}

int TapeBuilder::formula(const formula::Formula& f, bool delayed) {
    if (const auto value = model::constant_value(model_, f)) return constant(*value);
    switch (f->kind) {
        case Kind::number: break;
        case Kind::name: {
            const int signal = model_.signal_index(f->name);
            if (signal >= 0) return this->signal(signal, delayed);
            if (inputs_.parameter.empty()) throw std::logic_error("a parameter inside a signal: " + f->name);
            return add(Op::input, inputs_.parameter[static_cast<std::size_t>(model_.parameter_index(f->name))]);
        }
        case Kind::negate: return add(Op::neg, formula(f->arguments[0], delayed));
        case Kind::call: {
            if (f->name == "der") return derivative(f);
            if (f->name == "delay") return delayed_input(inputs_.delay.at({formula::text(f), delayed}));
            const auto relay = inputs_.relay.find(f.get());
            if (relay != inputs_.relay.end()) {
                const int value = add(Op::input, relay->second.input);
                return relay->second.turned ? add(Op::neg, value) : value;
            }
            const int a = formula(f->arguments[0], delayed);
            const auto layer = inputs_.layer.find(f.get());
            if (layer != inputs_.layer.end()) {
                const int ramp = add(Op::div, a, add(Op::input, layer->second));
                const int below = add(Op::min, ramp, constant(1));
                return add(Op::max, below, constant(-1));
            }
            return add(op_of_function(f->name), a, f->arguments.size() > 1 ? formula(f->arguments[1], delayed) : -1);
        }
        case Kind::power: {
            const int base = formula(f->arguments[0], delayed);
            const int exponent = formula(f->arguments[1], delayed);
            if (is_constant(exponent) && exact::is_integer(value(exponent)) && cln::abs(value(exponent)) <= formula::largest_exponent) {
                return power(base, cln::cl_I_to_int(cln::numerator(value(exponent))));
            }
            if (is_constant(exponent) && value(exponent) == Rational(1) / 2) return add(Op::sqrt, base);
            return add(Op::pow, base, exponent);
        }
        case Kind::add:
        case Kind::subtract:
        case Kind::multiply:
        case Kind::divide: {
            const int a = formula(f->arguments[0], delayed);
            const int b = formula(f->arguments[1], delayed);
            return add(f->kind == Kind::add ? Op::add : f->kind == Kind::subtract ? Op::sub : f->kind == Kind::multiply ? Op::mul : Op::div, a, b);
        }
    }
    throw std::logic_error("a number without a value");
}

int TapeBuilder::signal(int k, bool delayed) {
    const int input = inputs_.signal[static_cast<std::size_t>(k)];
    const formula::Formula& computed = model_.signals[static_cast<std::size_t>(k)].formula;
    if (input < 0 && computed) return formula(computed, delayed);
    return add(delayed ? Op::previous : Op::input, input);
}

int TapeBuilder::derivative(const formula::Formula& der) {
    const int signal = model_.signal_index(der->arguments[0]->name);
    const int order = formula::derivative_order(der);
    const auto known = inputs_.derivative.find({signal, order});
    if (known != inputs_.derivative.end()) return add(Op::input, known->second);
    return add(Op::derivative, inputs_.signal[static_cast<std::size_t>(signal)]);
}

int TapeBuilder::delayed_input(const DelayedInput& d) {
    const int newer = add(d.op, d.newer);
    if (d.older < 0) return newer;
    const int older = add(d.op, d.older);
    const int part = add(Op::mul, newer, constant(1 - d.rest));
    const int rest = add(Op::mul, older, constant(d.rest));
    return add(Op::add, part, rest);
}

int TapeBuilder::product(const equation::OperatorForm& form, const equation::Product& product, bool delayed) {
    int above = constant(1);
    int below = constant(1);
    for (const equation::Factor& factor : product) {
        const int atom = formula(form.atoms[static_cast<std::size_t>(factor.atom)].formula, delayed);
        int& side = factor.power > 0 ? above : below;
        side = add(Op::mul, side, power(atom, std::abs(factor.power)));
    }
    return add(Op::div, above, below);
}

int TapeBuilder::polynomial(const Polynomial& p, const std::vector<int>& variables) {
    int out = -1;
    for (const auto& [exponents, coefficient] : p) {
        int term = constant(cln::abs(coefficient));
        for (std::size_t k = 0; k < exponents.size(); ++k) {
            if (exponents[k] != 0) term = add(Op::mul, term, power(variables.empty() ? input(static_cast<int>(k)) : variables[k], exponents[k]));
        }
        const bool negative = cln::minusp(coefficient);
        if (out < 0) out = negative ? add(Op::neg, term) : term;
        else out = add(negative ? Op::sub : Op::add, out, term);
    }
    return out < 0 ? constant(0) : out;
}

int TapeBuilder::quotient(const Quotient& q, const std::vector<int>& variables) {
    const int above = polynomial(q.numerator, variables);
    return add(Op::div, above, polynomial(q.denominator, variables));
}

// Sums and products of derivatives: -1 is zero, and what is constant becomes one constant.
int TapeBuilder::sum_of(int a, int b) {
    if (a < 0 || b < 0) return a < 0 ? b : a;
    return is_constant(a) && is_constant(b) ? constant(value(a) + value(b)) : add(Op::add, a, b);
}
int TapeBuilder::difference_of(int a, int b) {
    if (b < 0) return a;
    if (a < 0) return is_constant(b) ? constant(-value(b)) : add(Op::neg, b);
    return is_constant(a) && is_constant(b) ? constant(value(a) - value(b)) : add(Op::sub, a, b);
}
int TapeBuilder::product_of(int a, int b) {
    if (a < 0 || b < 0) return -1;
    if (is_constant(b) && value(b) == 1) return a;
    return is_constant(a) && is_constant(b) ? constant(value(a) * value(b)) : add(Op::mul, a, b);
}
int TapeBuilder::quotient_of(int a, int b) {
    if (a < 0) return -1;
    return is_constant(a) && is_constant(b) && !cln::zerop(value(b)) ? constant(value(a) / value(b)) : add(Op::div, a, b);
}

int TapeBuilder::partial(int operation, Op kind, int k) {
    const auto [known, fresh] = partials_.try_emplace({operation, kind, k}, -1);
    if (fresh) known->second = derived(operation, kind, k);   // a map's places stay where they are
    return known->second;
}

// One call a statement: operations are numbered in the order in which they are made, and that of arguments is the compiler's.
int TapeBuilder::derived(int operation, Op kind, int k) {
    const Entry e = entries_[static_cast<std::size_t>(operation)];
    if (e.op == Op::constant) return -1;
    if (reads_input(e.op)) return e.op == kind && e.a == k ? constant(1) : -1;
    const int da = partial(e.a, kind, k);
    const int db = e.b < 0 ? -1 : partial(e.b, kind, k);
    if (da < 0 && db < 0) return -1;
    switch (e.op) {
        case Op::neg: return difference_of(-1, da);
        case Op::add: return sum_of(da, db);
        case Op::sub: return difference_of(da, db);
        case Op::mul: {
            const int first = product_of(da, e.b);
            const int second = product_of(db, e.a);
            return sum_of(first, second);
        }
        case Op::div: {
            const int second = product_of(db, operation);
            const int above = difference_of(da, second);
            return quotient_of(above, e.b);
        }
        case Op::sqrt: {
            const int two = constant(2);
            const int below = product_of(two, operation);
            return quotient_of(da, below);
        }
        case Op::exp: return product_of(da, operation);
        case Op::log: return quotient_of(da, e.a);
        case Op::sin: {
            const int slope = add(Op::cos, e.a);
            return product_of(da, slope);
        }
        case Op::cos: {
            const int slope = add(Op::sin, e.a);
            const int part = product_of(da, slope);
            return difference_of(-1, part);
        }
        case Op::tan: {
            const int square = product_of(operation, operation);
            const int one = constant(1);
            const int slope = sum_of(one, square);
            return product_of(da, slope);
        }
        case Op::abs: {
            const int slope = add(Op::sgn, e.a);
            return product_of(da, slope);
        }
        case Op::sgn: return -1;
        case Op::min:
        case Op::max: {   // the mean of both slopes, and half their difference to the side that counts
            const int ahead = e.op == Op::max ? difference_of(e.a, e.b) : difference_of(e.b, e.a);
            const int side = add(Op::sgn, ahead);
            const int half = constant(Rational(1) / 2);
            const int both = sum_of(da, db);
            const int mean = product_of(half, both);
            const int apart = difference_of(da, db);
            const int half_apart = product_of(half, apart);
            const int turned = product_of(half_apart, side);
            return sum_of(mean, turned);
        }
        case Op::pow: {
            const int one = constant(1);
            const int exponent = difference_of(e.b, one);
            const int power_below = add(Op::pow, e.a, exponent);
            const int slope = product_of(e.b, power_below);
            const int by_base = product_of(slope, da);
            if (db < 0) return by_base;
            const int logarithm = add(Op::log, e.a);
            const int growth = product_of(operation, logarithm);
            const int by_exponent = product_of(growth, db);
            return sum_of(by_base, by_exponent);
        }
        case Op::constant:
        case Op::input:
        case Op::previous:
        case Op::derivative: break;
    }
    return -1;
}

plan::Tape TapeBuilder::finish() const {
    std::vector<bool> needed(entries_.size(), false);
    for (const int r : results_) needed[static_cast<std::size_t>(r)] = true;
    for (std::size_t k = entries_.size(); k-- > 0;) {
        if (!needed[k] || reads_input(entries_[k].op)) continue;
        if (entries_[k].a >= 0) needed[static_cast<std::size_t>(entries_[k].a)] = true;
        if (entries_[k].b >= 0) needed[static_cast<std::size_t>(entries_[k].b)] = true;
    }
    plan::Tape out;
    std::vector<int> place(entries_.size(), -1);
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        if (!needed[k]) continue;
        const Entry& e = entries_[k];
        const auto moved = [&](int index) { return index < 0 || reads_input(e.op) ? index : place[static_cast<std::size_t>(index)]; };
        place[k] = static_cast<int>(out.operations.size());
        out.operations.push_back({e.op, moved(e.a), moved(e.b), e.op == Op::constant ? exact::nearest(e.value, scalar_) : 0.0});
    }
    for (const int r : results_) out.results.push_back(place[static_cast<std::size_t>(r)]);
    return out;
}

}  // namespace algest
