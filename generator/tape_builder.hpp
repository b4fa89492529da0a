// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas, signal products and quotients of polynomials -> operations of a tape: equal ones once, formulas of constants as their values.
#pragma once
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "generator/equation.hpp"
#include "generator/tape.hpp"

namespace algest {

/// What a call of delay() reads: an input, or between two of them.
struct DelayedInput {
    plan::Op op;             ///< input or previous
    int newer;
    int older;               ///< -1: none
    exact::Rational rest;    ///< of the older one, 0 to 1
};

/// The value of a sgn() as an input of the tape.
struct Relay {
    int input;
    bool turned;   ///< minus the input
};

/// Which inputs of the tape the names of a model are.
struct TapeInputs {
    std::vector<int> signal;                               ///< by the model's signals; -1: not an input, a computed one is then its formula
    std::vector<int> parameter = {};                       ///< by the model's parameters; empty: they may not occur
    std::map<std::pair<int, int>, int> derivative = {};    ///< (signal, order); one that is not here is left to the parabola filter
    std::map<const formula::Node*, Relay> relay = {};      ///< calls of sgn() whose value is an input; none else
    std::map<const formula::Node*, int> layer = {};        ///< calls of sgn() that rise from -1 to 1 over twice the width that is an input; none else
    std::map<std::pair<std::string, bool>, DelayedInput> delay = {};   ///< calls of delay(), by their text and whether all is one sample late; one that is not here may not occur
};

class TapeBuilder {
public:
    TapeBuilder(const model::Model& model, plan::Scalar scalar, TapeInputs inputs)
        : model_(model), scalar_(scalar), inputs_(std::move(inputs)) {}

    /// A formula; delayed: as below.
    int formula(const formula::Formula& f, bool delayed = false);

    /// left - right.
    int difference(int left, int right) { return add(plan::Op::sub, left, right); }

    /// A product of atoms. delayed: every signal one sample late, derivatives by the parabola filter.
    int product(const equation::OperatorForm& form, const equation::Product& product, bool delayed);

    /// A quotient of polynomials in the operations of `variables`; empty: in the tape's inputs 0, 1, ...
    int quotient(const Quotient& q, const std::vector<int>& variables = {});
    /// left * right.
    int times(int left, int right) { return add(plan::Op::mul, left, right); }
    /// A measured or computed signal of the model.
    int signal(int k, bool delayed = false);
    int input(int k) { return add(plan::Op::input, k); }

    /// d operation / d (input k, as `kind` reads it: input, previous or derivative), by the rules of differentiation, operation by
    /// operation; -1 where it is zero everywhere, or almost (sgn). A constant one is a single operation.
    int partial(int operation, plan::Op kind, int k);
    /// A result that is zero where `operation` is -1.
    void result_or_zero(int operation) { result(operation < 0 ? constant(0) : operation); }
    /// The value of an operation that is constant.
    std::optional<exact::Rational> constant_value(int operation) const { return is_constant(operation) ? std::optional(value(operation)) : std::nullopt; }

    void result(int operation) { results_.push_back(operation); }

    /// The finished tape, without operations that no result needs.
    plan::Tape finish() const;

private:
    struct Entry {
        plan::Op op;
        int a;
        int b;
        exact::Rational value;
    };
    int add(plan::Op op, int a = -1, int b = -1);
    int constant(const exact::Rational& value);
    int power(int base, int exponent);
    int derivative(const formula::Formula& der);
    int delayed_input(const DelayedInput& d);
    int polynomial(const Polynomial& p, const std::vector<int>& variables);
    int derived(int operation, plan::Op kind, int k);
    int sum_of(int a, int b);
    int difference_of(int a, int b);
    int product_of(int a, int b);
    int quotient_of(int a, int b);
    bool is_constant(int k) const { return entries_[static_cast<std::size_t>(k)].op == plan::Op::constant; }
    const exact::Rational& value(int k) const { return entries_[static_cast<std::size_t>(k)].value; }

    const model::Model& model_;
    plan::Scalar scalar_;
    TapeInputs inputs_;
    std::vector<Entry> entries_;
    std::map<std::tuple<plan::Op, int, int>, int> known_;
    std::vector<std::pair<exact::Rational, int>> constants_;
    std::map<std::tuple<int, plan::Op, int>, int> partials_;
    std::vector<int> results_;
};

}  // namespace algest
