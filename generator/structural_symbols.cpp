// SPDX-License-Identifier: GPL-3.0-or-later
// The symbols of a model's formulas, their derivatives in time.
#include <algorithm>
#include <cmath>

#include "generator/constant_value.hpp"
#include "generator/ginac_exact.hpp"
#include "generator/structural_form.hpp"

namespace algest::structure {

using formula::Formula;
using formula::Kind;
using GiNaC::ex;
using GiNaC::exmap;
using GiNaC::symbol;

namespace {

template <class Use>
void each_symbol(const ex& e, Use use) {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        if (GiNaC::is_a<symbol>(*part)) use(*part);
    }
}

}  // namespace

Symbols::Symbols(const model::Model& model) : model_(model), time_("t") {
    for (const model::Parameter& p : model.parameters) parameters_.emplace_back(p.name);
    for (const model::Equation& e : model.equations) {
        for (const Formula& side : {e.sides.left, e.sides.right}) model::add_delays(model, side, delays_);
    }
}

symbol Symbols::jet(Jet j) {
    const auto known = jets_.find(j);
    if (known != jets_.end()) return known->second;
    const symbol fresh("x" + std::to_string(j.signal) + "_" + std::to_string(j.order));
    jets_.emplace(j, fresh);
    jet_of_.emplace(fresh, j);
    return fresh;
}

std::optional<Jet> Symbols::jet_of(const ex& s) const {
    const auto known = jet_of_.find(s);
    return known == jet_of_.end() ? std::nullopt : std::optional(known->second);
}

std::optional<std::size_t> Symbols::atom_of(const ex& s) const {
    const auto known = atom_of_.find(s);
    return known == atom_of_.end() ? std::nullopt : std::optional(known->second);
}

int Symbols::delayed(const Formula& f) {
    const std::string text = formula::text(f);
    const auto at = std::find_if(delays_.begin(), delays_.end(), [&](const model::Delay& d) { return d.text == text; });
    return static_cast<int>(model_.signals.size()) + static_cast<int>(at - delays_.begin());
}

int Symbols::delay_parameter(int signal) const {
    const auto plain = static_cast<int>(model_.signals.size());
    return signal < plain ? -1 : delays_[static_cast<std::size_t>(signal - plain)].parameter;
}

ex Symbols::of(const Formula& f) {
    if (const auto value = model::constant_value(model_, f)) return to_ginac(*value);
    switch (f->kind) {
        case Kind::number: return to_ginac(f->value);
        case Kind::name: {
            const int p = model_.parameter_index(f->name);
            if (p >= 0) return parameters_[static_cast<std::size_t>(p)];
            const int s = model_.signal_index(f->name);
            const model::Signal& signal = model_.signals[static_cast<std::size_t>(s)];
            return signal.formula ? of(signal.formula) : ex(jet({s, 0}));
        }
        case Kind::negate: return -of(f->arguments[0]);
        case Kind::add: return of(f->arguments[0]) + of(f->arguments[1]);
        case Kind::subtract: return of(f->arguments[0]) - of(f->arguments[1]);
        case Kind::multiply: return of(f->arguments[0]) * of(f->arguments[1]);
        case Kind::divide: return of(f->arguments[0]) / of(f->arguments[1]);
        case Kind::power: return power(f->arguments[0], f->arguments[1]);
        case Kind::call: break;
    }
    return call(f);
}

ex Symbols::power(const Formula& base, const Formula& exponent) {
    const auto value = model::constant_value(model_, exponent);
    if (value && exact::is_integer(*value)) return GiNaC::pow(of(base), to_ginac(*value));
    if (value && exact::is_integer(2 * *value)) return GiNaC::pow(function(Atom::Kind::root, of(base)), to_ginac(2 * *value));
    return function(Atom::Kind::exponential, of(exponent) * function(Atom::Kind::logarithm, of(base)));
}

ex Symbols::call(const Formula& f) {
    if (f->name == "delay") return jet({delayed(f), 0});
    const ex x = of(f->arguments[0]);
    if (f->name == "der") {
        ex out = x;
        for (int k = formula::derivative_order(f); k > 0; --k) out = derivative(out);
        return out;
    }
    if (f->name == "sin") return function(Atom::Kind::sine, x);
    if (f->name == "cos") return function(Atom::Kind::cosine, x);
    if (f->name == "tan") return function(Atom::Kind::sine, x) / function(Atom::Kind::cosine, x);
    if (f->name == "exp") return function(Atom::Kind::exponential, x);
    if (f->name == "log") return function(Atom::Kind::logarithm, x);
    if (f->name == "sqrt") return function(Atom::Kind::root, x);
    if (f->name == "sgn") return sign(x);
    if (f->name == "abs") return x * sign(x);
    const ex y = of(f->arguments[1]);   // min, max
    const ex apart = (x - y) * sign(x - y);
    return (x + y + (f->name == "max" ? apart : -apart)) / 2;
}

ex Symbols::sign(const ex& argument) { return function(Atom::Kind::sign, argument); }

ex Symbols::function(Atom::Kind kind, const ex& argument) {
    const ex x = argument.expand();
    if (x.is_zero() && (kind == Atom::Kind::sine || kind == Atom::Kind::sign)) return 0;
    for (const Atom& known : atoms_) {
        if (known.kind != kind) continue;
        if (known.argument.is_equal(x)) return known.symbol;
        const ex ratio = known.argument.is_equal(-x) ? ex(-1) : kind == Atom::Kind::sign ? over_one_bar(x / known.argument) : ex(0);
        const bool negative = GiNaC::is_a<GiNaC::numeric>(ratio) && GiNaC::ex_to<GiNaC::numeric>(ratio).is_negative();
        if (kind == Atom::Kind::sign && GiNaC::is_a<GiNaC::numeric>(ratio)) return negative ? ex(-known.symbol) : ex(known.symbol);
        if (!negative) continue;
        if (kind == Atom::Kind::sine) return -known.symbol;
        if (kind == Atom::Kind::cosine) return known.symbol;
        if (kind == Atom::Kind::exponential) return 1 / known.symbol;
    }
    atoms_.push_back({kind, x, symbol("f" + std::to_string(atoms_.size()))});
    atom_of_.emplace(atoms_.back().symbol, atoms_.size() - 1);
    return atoms_.back().symbol;
}

ex Symbols::perturbation(int kappa) {
    ex out = 0;
    for (int i = 0; i < kappa; ++i) {
        nuisances_.emplace_back("c" + std::to_string(nuisances_.size()));
        out += nuisances_.back() * GiNaC::pow(time_, i);
    }
    return out;
}

ex Symbols::derivative(const ex& e) {
    GiNaC::exset seen;
    std::vector<std::size_t> functions;   // sorted: what is first met is numbered first, and a set runs in another order each time
    each_symbol(e, [&](const ex& s) {
        if (!seen.insert(s).second) return;
        if (const auto a = atom_of(s)) functions.push_back(*a);
    });
    std::sort(functions.begin(), functions.end());
    ex out = e.diff(time_);
    for (const ex& s : seen) {
        if (const auto j = jet_of(s)) out += e.diff(GiNaC::ex_to<symbol>(s)) * jet({j->signal, j->order + 1});
    }
    for (const std::size_t a : functions) {
        const Atom atom = atoms_[a];
        const auto partial = [&] { return e.diff(atom.symbol); };
        const ex inner = derivative(atom.argument);
        switch (atom.kind) {
            case Atom::Kind::sine: out += partial() * function(Atom::Kind::cosine, atom.argument) * inner; break;
            case Atom::Kind::cosine: out -= partial() * function(Atom::Kind::sine, atom.argument) * inner; break;
            case Atom::Kind::exponential: out += partial() * atom.symbol * inner; break;
            case Atom::Kind::logarithm: out += partial() * inner / atom.argument; break;
            case Atom::Kind::root: out += partial() * inner / (2 * atom.symbol); break;
            case Atom::Kind::sign: break;   // constant almost everywhere
        }
    }
    return out;
}

ex Symbols::substituted(const ex& e, const exmap& by) {
    exmap all = by;
    for (const std::size_t a : atoms_in(e)) {   // in the order of their numbers, so that new ones are numbered alike in each run
        const Atom atom = atoms_[a];
        if (!e.has(atom.symbol)) continue;
        const ex argument = substituted(atom.argument, by);
        if (!argument.is_equal(atom.argument)) all[atom.symbol] = function(atom.kind, argument);
    }
    return e.subs(all, GiNaC::subs_options::no_pattern);
}

std::vector<std::size_t> Symbols::atoms_in(const ex& e) const {
    std::vector<std::size_t> out;
    each_symbol(e, [&](const ex& s) {
        const auto a = atom_of(s);
        if (!a || std::find(out.begin(), out.end(), *a) != out.end()) return;
        out.push_back(*a);
        for (const std::size_t inner : atoms_in(atoms_[*a].argument)) {
            if (std::find(out.begin(), out.end(), inner) == out.end()) out.push_back(inner);
        }
    });
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<Jet> Symbols::jets(const ex& e) const {
    std::vector<Jet> out;
    const auto take = [&](const ex& part) {
        each_symbol(part, [&](const ex& s) {
            if (const auto j = jet_of(s)) out.push_back(*j);
        });
    };
    take(e);
    for (const std::size_t a : atoms_in(e)) take(atoms_[a].argument);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end(), [](const Jet& a, const Jet& b) { return !(a < b) && !(b < a); }), out.end());
    return out;
}

bool Symbols::inside_atom(const ex& e, Jet j) const {
    const auto known = jets_.find(j);
    if (known == jets_.end()) return false;
    const auto inside = atoms_in(e);
    return std::any_of(inside.begin(), inside.end(), [&](std::size_t a) { return atoms_[a].argument.has(known->second); });
}

ex Symbols::lowered(const ex& polynomial) const {
    ex out = polynomial.expand();
    for (const std::size_t a : atoms_in(out)) {
        const Atom& atom = atoms_[a];
        ex square;
        if (atom.kind == Atom::Kind::sign) square = 1;
        else if (atom.kind == Atom::Kind::root && atom.argument.info(GiNaC::info_flags::polynomial)) square = atom.argument;
        else if (atom.kind == Atom::Kind::cosine) {
            const auto sine = std::find_if(atoms_.begin(), atoms_.end(), [&](const Atom& b) { return b.kind == Atom::Kind::sine && b.argument.is_equal(atom.argument); });
            if (sine == atoms_.end()) continue;
            square = 1 - sine->symbol * sine->symbol;
        } else continue;
        ex low = 0;
        for (int k = 0; k <= out.degree(atom.symbol); ++k) low += out.coeff(atom.symbol, k) * GiNaC::pow(square, k / 2) * GiNaC::pow(atom.symbol, k % 2);
        out = low.expand();
    }
    return out;
}

double terms_at_most(const ex& e) {
    if (GiNaC::is_a<GiNaC::add>(e)) {
        double out = 0;
        for (const ex& part : e) out += terms_at_most(part);
        return out;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        double out = 1;
        for (const ex& part : e) out *= terms_at_most(part);
        return out;
    }
    if (!GiNaC::is_a<GiNaC::power>(e) || !GiNaC::is_a<GiNaC::numeric>(e.op(1))) return 1;
    const double terms = terms_at_most(e.op(0));
    double out = 1;
    const double exponent = std::min(1000.0, std::abs(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_double()));
    for (int k = 1; k <= exponent && out <= most_terms; ++k) out = out * (terms + k - 1) / k;
    return out;
}

ex over_one_bar(const ex& e) {
    if (terms_at_most(e) > most_terms) throw TooLong{};
    return e.normal();
}

}  // namespace algest::structure
