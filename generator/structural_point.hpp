// SPDX-License-Identifier: GPL-3.0-or-later
// A random point of a model modulo the prime, at which its square roots exist.
#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "generator/modular.hpp"
#include "generator/structural_form.hpp"

namespace algest::structure {

/// Values of parameters, and of signals and their derivatives at one instant. Each is drawn from what it belongs to, never from the order in
/// which it is asked for: GiNaC walks its sums in another order in each run.
class Point {
public:
    using Number = modular::Number;

    explicit Point(const Symbols& symbols) : symbols_(symbols) {}

    Number parameter(std::size_t k) const { return drawn(Of::parameter, static_cast<int>(k), 0); }
    Number nuisance(std::size_t k) const { return modular::drawn({static_cast<std::uint64_t>(Of::nuisance), k}); }
    Number time() const { return modular::drawn({static_cast<std::uint64_t>(Of::time), stretch_}); }
    /// The derivative's value.
    Number jet(Jet j) const { return drawn(Of::jet, j.signal, j.order); }
    /// Of exp() and log(): any number, the same for the same argument. Of sin() and cos(): tan of half the angle.
    Number function(Atom::Kind kind, Number argument) const { return modular::drawn({static_cast<std::uint64_t>(Of::function), static_cast<std::uint64_t>(kind), argument.value()}); }
    /// Of a constant that has none any number stands for it, as for exp(2).
    Number root(const GiNaC::ex& argument, Number value) const;
    /// 1 or -1: bit k of the stretch's `signs` is that of the model's k-th sgn().
    Number sign(std::size_t atom) const;

    /// Parameters at which the roots of parameters alone exist. False: not found.
    bool settle_parameters(const std::vector<std::size_t>& roots);
    /// Another stretch: other signals, the same parameters; moves signals until the other roots exist too. False: not found.
    bool settle(std::uint64_t stretch, unsigned signs, const std::vector<std::size_t>& roots);

private:
    enum class Of : std::uint64_t { parameter = 1, nuisance, time, jet, function };
    /// What may be drawn anew: a parameter (its index) or a jet.
    struct Free {
        Of of;
        int index;
        int order;
        friend bool operator<(const Free& a, const Free& b) { return a.of != b.of ? a.of < b.of : a.index != b.index ? a.index < b.index : a.order < b.order; }
    };

    Number drawn(Of of, int index, int order) const;
    Number at(const GiNaC::ex& e) const;
    Number at_symbol(const GiNaC::ex& s) const;
    Number at_atom(std::size_t a) const;
    std::vector<Free> parameters_in(const GiNaC::ex& argument) const;
    std::vector<std::size_t> without_root(const std::vector<std::size_t>& roots) const;
    bool search(const std::vector<std::size_t>& roots, bool parameters);

    static constexpr unsigned sign_bits = 30;   // of `signs`, whose patterns are numbers below 2^31

    const Symbols& symbols_;
    std::uint64_t stretch_ = 0;
    unsigned signs_ = 0;
    std::map<Free, std::uint64_t> draws_;   // how often each was drawn anew
};

/// By t = tan of half the angle.
inline modular::Number sine_of_half(modular::Number t) { return (t + t) / (modular::Number(1) + t * t); }
inline modular::Number cosine_of_half(modular::Number t) { return (modular::Number(1) - t * t) / (modular::Number(1) + t * t); }

/// Roots in the right sides, those inside other functions too; not those of constants.
std::vector<std::size_t> roots_in(const std::vector<Explicit>& equations, const Symbols& symbols);

}  // namespace algest::structure
