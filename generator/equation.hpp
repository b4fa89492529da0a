// SPDX-License-Identifier: GPL-3.0-or-later
// ODE text -> operator form: a sum of coefficient(parameters) * product(signals) that is zero.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "generator/polynomial.hpp"

namespace algest::equation {

/// What signal products are made of: a signal, a derivative of one, or a function of signals and constants.
struct Atom {
    enum class Kind { signal, derivative, function };
    Kind kind;
    int signal;                   ///< index into the model's signals; -1 for a function
    int order;                    ///< of the derivative; 0 otherwise
    formula::Formula formula;     ///< what it stands for
    std::string text;
    std::vector<int> arguments;   ///< signals that occur in it
    bool differentiates;          ///< a function with der() inside
};

/// One factor atom^power, power != 0 (negative: in the denominator).
struct Factor {
    int atom;
    int power;
    friend bool operator<(const Factor& a, const Factor& b) { return a.atom != b.atom ? a.atom < b.atom : a.power < b.power; }
    friend bool operator==(const Factor& a, const Factor& b) { return a.atom == b.atom && a.power == b.power; }
};
/// A product of atoms, sorted by atom; empty: the constant 1.
using Product = std::vector<Factor>;

struct Term {
    Polynomial coefficient;   ///< in the model's parameters
    Product product;
};

/// sum of terms = 0. Terms stand in the order in which their atoms appear in the text.
struct OperatorForm {
    std::vector<Atom> atoms;
    std::vector<Term> terms;
    int n;                    ///< highest order of a derivative that stands alone
    int leading;              ///< index of the first term of order n that stands alone; -1: n is 0 and nothing stands alone
    bool delayed;             ///< a derivative inside a nonlinearity: all signals one sample late

    /// Order of the derivative that a product is, 0 for everything that is no lone derivative.
    int order(const Product& product) const;
    /// True when the product has no signal in it.
    bool is_constant(const Product& product) const;
    /// "i1^2/(s + Z)^2"
    std::string text(const Product& product) const;
    std::string latex(const Product& product) const;
};

/// Complains and returns nullopt where a parameter enters nonlinearly in a way that no product of unknowns can express, or
/// a derivative of order above 1 stands inside a nonlinearity.
std::optional<OperatorForm> operator_form(const model::Model& model, const model::Equation& equation, Diagnostics& diagnostics);

/// A parameter of which no product of unknowns can be made.
struct NonlinearParameter {
    std::string name;
    std::string where;   ///< it stands there: "inside exp()"
    Position at;
};

/// The first one of an equation: then it has no operator form, and only a free run can tell the parameter.
std::optional<NonlinearParameter> nonlinear_parameter(const model::Model& model, const model::Equation& equation);

}  // namespace algest::equation
