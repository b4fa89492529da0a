// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/structural_point.hpp"

#include <algorithm>
#include <stdexcept>

#include "generator/ginac_exact.hpp"

namespace algest::structure {

namespace {

using GiNaC::ex;
using modular::Number;

/// Every other number has a root, so that roots of signals of their own take two draws each; ten roots of one signal a thousand. Some seconds.
constexpr std::uint64_t most_draws = 10000;

}  // namespace

Number Point::drawn(Of of, int index, int order) const {
    const auto again = draws_.find({of, index, order});
    const std::uint64_t stretch = of == Of::parameter ? 0 : stretch_;
    return modular::drawn({static_cast<std::uint64_t>(of), stretch, static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(order), again == draws_.end() ? 0 : again->second});
}

Number Point::root(const ex& argument, Number value) const {
    const bool constant = GiNaC::is_a<GiNaC::numeric>(argument);
    return constant && !modular::has_root(value) ? function(Atom::Kind::root, value) : modular::root_of(value);
}

Number Point::sign(std::size_t atom) const {
    const auto& atoms = symbols_.atoms();
    const auto before = std::count_if(atoms.begin(), atoms.begin() + static_cast<std::ptrdiff_t>(atom), [](const Atom& a) { return a.kind == Atom::Kind::sign; });
    return ((signs_ >> (static_cast<unsigned>(before) % sign_bits)) & 1U) != 0 ? 1 : -1;
}

Number Point::at(const ex& e) const {
    if (GiNaC::is_a<GiNaC::numeric>(e)) return modular::from(from_ginac(e));
    if (GiNaC::is_a<GiNaC::symbol>(e)) return at_symbol(e);
    if (GiNaC::is_a<GiNaC::power>(e)) {
        const int exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int();
        const Number whole = at(e.op(0)).power(static_cast<std::uint64_t>(std::abs(exponent)));
        return exponent < 0 ? whole.inverse() : whole;
    }
    const bool sum = GiNaC::is_a<GiNaC::add>(e);
    Number out = sum ? 0 : 1;
    for (const ex& part : e) out = sum ? out + at(part) : out * at(part);
    return out;
}

Number Point::at_symbol(const ex& s) const {
    if (const auto j = symbols_.jet_of(s)) return jet(*j);
    if (const auto a = symbols_.atom_of(s)) return at_atom(*a);
    if (s.is_equal(symbols_.time())) return time();
    for (std::size_t k = 0; k < symbols_.parameters().size(); ++k) if (s.is_equal(symbols_.parameters()[k])) return parameter(k);
    for (std::size_t k = 0; k < symbols_.nuisances().size(); ++k) if (s.is_equal(symbols_.nuisances()[k])) return nuisance(k);
    throw std::logic_error("a symbol of no kind");
}

Number Point::at_atom(std::size_t a) const {
    const Atom& atom = symbols_.atoms()[a];
    if (atom.kind == Atom::Kind::sign) return sign(a);
    const Number argument = at(atom.argument);
    switch (atom.kind) {
        case Atom::Kind::root: return root(atom.argument, argument);
        case Atom::Kind::sine: return sine_of_half(function(Atom::Kind::sine, argument));
        case Atom::Kind::cosine: return cosine_of_half(function(Atom::Kind::sine, argument));
        default: return function(atom.kind, argument);
    }
}

std::vector<Point::Free> Point::parameters_in(const ex& argument) const {
    std::vector<Free> out;
    const auto inner = symbols_.atoms_in(argument);
    for (std::size_t k = 0; k < symbols_.parameters().size(); ++k) {
        const ex p = symbols_.parameters()[k];
        const bool inside = std::any_of(inner.begin(), inner.end(), [&](std::size_t a) { return symbols_.atoms()[a].argument.has(p); });
        if (inside || argument.has(p)) out.push_back({Of::parameter, static_cast<int>(k), 0});
    }
    return out;
}

std::vector<std::size_t> Point::without_root(const std::vector<std::size_t>& roots) const {
    std::vector<std::size_t> out;
    for (const std::size_t a : roots) if (!modular::has_root(at(symbols_.atoms()[a].argument))) out.push_back(a);
    return out;
}

/// Draws something in the argument of a missing root anew, and keeps that unless more roots are missing then.
bool Point::search(const std::vector<std::size_t>& roots, bool parameters) {
    std::vector<std::size_t> missing = without_root(roots);
    for (std::uint64_t n = 0; !missing.empty() && n < most_draws; ++n) {
        const ex& argument = symbols_.atoms()[missing[modular::drawn({n, 1}).value() % missing.size()]].argument;
        std::vector<Free> free;
        if (parameters) free = parameters_in(argument);
        else for (const Jet& j : symbols_.jets(argument)) free.push_back({Of::jet, j.signal, j.order});
        if (free.empty()) return false;
        const Free moved = free[modular::drawn({n, 2}).value() % free.size()];
        const auto before = draws_;
        draws_[moved] = n + 1;
        const std::vector<std::size_t> now = without_root(roots);
        if (now.size() > missing.size()) draws_ = before;
        else missing = now;
    }
    return missing.empty();
}

bool Point::settle_parameters(const std::vector<std::size_t>& roots) {
    std::vector<std::size_t> of_parameters;
    for (const std::size_t a : roots) if (symbols_.jets(symbols_.atoms()[a].argument).empty()) of_parameters.push_back(a);
    return search(of_parameters, true);
}

bool Point::settle(std::uint64_t stretch, unsigned signs, const std::vector<std::size_t>& roots) {
    stretch_ = stretch;
    signs_ = signs;
    std::erase_if(draws_, [](const auto& draw) { return draw.first.of == Of::jet; });
    return search(roots, false);
}

std::vector<std::size_t> roots_in(const std::vector<Explicit>& equations, const Symbols& symbols) {
    std::vector<std::size_t> out;
    for (const Explicit& e : equations) {
        for (const std::size_t a : symbols.atoms_in(e.right)) {
            const Atom& atom = symbols.atoms()[a];
            const bool known = std::find(out.begin(), out.end(), a) != out.end();
            if (atom.kind == Atom::Kind::root && !GiNaC::is_a<GiNaC::numeric>(atom.argument) && !known) out.push_back(a);
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace algest::structure
