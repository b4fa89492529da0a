// SPDX-License-Identifier: GPL-3.0-or-later
// A model's equations as a triangle: each solved for one highest derivative that stands in no other. What structural verdicts start from.
#pragma once
#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/delay.hpp"
#include "generator/model.hpp"

namespace algest::structure {

/// A derivative of a signal. Signals count as in the model; behind them stand delayed ones, signals of their own.
struct Jet {
    int signal;
    int order;
    friend bool operator<(const Jet& a, const Jet& b) { return a.signal != b.signal ? a.signal < b.signal : a.order < b.order; }
};

/// A function of signals and parameters that has a symbol of its own. Others are made of these: abs(x) = x sgn(x), tan = sin/cos.
struct Atom {
    enum class Kind { sine, cosine, exponential, logarithm, root, sign };
    Kind kind;
    GiNaC::ex argument;
    GiNaC::symbol symbol;
};

/// The symbols of a model, and how an expression of them runs in time.
class Symbols {
public:
    explicit Symbols(const model::Model& model);

    GiNaC::symbol jet(Jet j);
    /// The jet, atom (its index) or nothing that a symbol is.
    std::optional<Jet> jet_of(const GiNaC::ex& symbol) const;
    std::optional<std::size_t> atom_of(const GiNaC::ex& symbol) const;
    const std::vector<Atom>& atoms() const { return atoms_; }
    const std::vector<GiNaC::symbol>& parameters() const { return parameters_; }
    /// Coefficients of annihilated perturbations.
    const std::vector<GiNaC::symbol>& nuisances() const { return nuisances_; }
    const GiNaC::symbol& time() const { return time_; }
    const std::vector<model::Delay>& delays() const { return delays_; }
    /// Index of the parameter by which a delayed signal is late; -1: none, or no delayed signal.
    int delay_parameter(int signal) const;

    /// A formula of the model; computed signals are written out.
    GiNaC::ex of(const formula::Formula& f);
    /// c1 + c2 t + ... of new nuisances.
    GiNaC::ex perturbation(int kappa);
    GiNaC::ex function(Atom::Kind kind, const GiNaC::ex& argument);
    /// d/dt
    GiNaC::ex derivative(const GiNaC::ex& e);
    /// Also inside the arguments of atoms.
    GiNaC::ex substituted(const GiNaC::ex& e, const GiNaC::exmap& by);
    /// All jets, those inside atoms too.
    std::vector<Jet> jets(const GiNaC::ex& e) const;
    /// True when a jet stands in the argument of an atom of the expression.
    bool inside_atom(const GiNaC::ex& e, Jet j) const;
    /// Atoms of an expression, and atoms in their arguments.
    std::vector<std::size_t> atoms_in(const GiNaC::ex& e) const;
    /// A polynomial in atoms brought to the lowest powers: cos^2 = 1 - sin^2, sgn^2 = 1, sqrt(x)^2 = x.
    GiNaC::ex lowered(const GiNaC::ex& polynomial) const;

private:
    GiNaC::ex call(const formula::Formula& f);
    GiNaC::ex power(const formula::Formula& base, const formula::Formula& exponent);
    GiNaC::ex sign(const GiNaC::ex& argument);
    int delayed(const formula::Formula& f);

    const model::Model& model_;
    std::vector<GiNaC::symbol> parameters_;
    std::vector<GiNaC::symbol> nuisances_;
    GiNaC::symbol time_;
    std::map<Jet, GiNaC::symbol> jets_;
    std::map<GiNaC::ex, Jet, GiNaC::ex_is_less> jet_of_;
    std::vector<Atom> atoms_;
    std::map<GiNaC::ex, std::size_t, GiNaC::ex_is_less> atom_of_;
    std::vector<model::Delay> delays_;
};

/// leader = right side, in which no leader and no derivative of one stands.
struct Explicit {
    Jet leader;
    GiNaC::ex right;
};

/// An implicit equation has a signal in common with another equation: it binds what the other takes for free.
struct Tie {
    const model::Equation* equation;   ///< the implicit one
    std::string signal;
    bool algebraic;                    ///< the others give signals, not derivatives, and are solved
};

/// The equations of a model.
struct Triangle {
    std::vector<Explicit> equations;
    std::vector<GiNaC::ex> implicit;   ///< = 0: linear in no signal that they could be solved for; by the model's signals alone, all measured
    std::vector<Tie> ties;
};

/// Brings the equations into that form, perturbations of kappa >= 1 included. Complains (bad input) about divisions by zero, equations that
/// contradict each other or hold a hidden signal and cannot be solved, and what is too long. Cost: substitutions, and one quotient brought to a
/// common denominator for each equation.
std::optional<Triangle> triangle(const model::Model& model, const std::vector<bool>& hidden, Symbols& symbols, Diagnostics& diagnostics);

/// An expression without leaders and their derivatives.
GiNaC::ex reduced(const GiNaC::ex& e, const std::vector<Explicit>& equations, Symbols& symbols);

/// Terms that an expression can have once it is multiplied out, at most; above `most_terms` nothing here multiplies out.
double terms_at_most(const GiNaC::ex& e);
constexpr double most_terms = 20000;
/// An expression is too long for this test.
struct TooLong {};
/// Over one bar, common factors removed. Throws TooLong.
GiNaC::ex over_one_bar(const GiNaC::ex& e);

}  // namespace algest::structure
