// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas as a flat list of operations: what is printed as C++ and what replay evaluates, in one and the same order.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "algest/arithmetic.hpp"

namespace algest::plan {

enum class Op : std::uint8_t {
    constant,    ///< value
    input,       ///< input a
    previous,    ///< input a, one sample ago
    derivative,  ///< d/dt of input a, one sample ago, by the parabola filter; per second
    neg, add, sub, mul, div,
    sqrt, exp, log, sin, cos, tan, abs, sgn, min, max,
    pow          ///< real power; integer powers are multiplications
};

/// One operation; a and b are indices of earlier operations (of inputs for input, previous and derivative).
struct Operation {
    Op op;
    int a;
    int b;
    double value;   ///< of a constant, already rounded to the plan's scalar
};

/// Operations in order, and the operations whose values are the results.
struct Tape {
    std::vector<Operation> operations;
    std::vector<int> results;
};

/// a op b; b is read by operations of two operands alone, a by all but those that read inputs.
template <class S>
[[gnu::always_inline]] inline S operated(Op op, const S* a, const S* b) {
    switch (op) {
        case Op::constant:
        case Op::input:
        case Op::previous:
        case Op::derivative: break;
        case Op::neg: return -*a;
        case Op::add: return *a + *b;
        case Op::sub: return *a - *b;
        case Op::mul: return *a * *b;
        case Op::div: return *a / *b;
        case Op::sqrt: return std::sqrt(*a);
        case Op::exp: return std::exp(*a);
        case Op::log: return std::log(*a);
        case Op::sin: return std::sin(*a);
        case Op::cos: return std::cos(*a);
        case Op::tan: return std::tan(*a);
        case Op::abs: return std::abs(*a);
        case Op::sgn: return algest::sgn(*a);
        case Op::min: return algest::smaller(*a, *b);
        case Op::max: return algest::larger(*a, *b);
        case Op::pow: return std::pow(*a, *b);
    }
    return S(0);
}

/// Evaluates a tape. `input`, `previous`, `derivative`: arrays over the inputs (unused ones may be null);
/// `values`: scratch, one per operation; `results`: one per result. Cost: one operation each. Total: never throws.
template <class S>
inline void evaluate(const Tape& tape, const S* input, const S* previous, const S* derivative, S* values, S* results) {
    for (std::size_t k = 0; k < tape.operations.size(); ++k) {
        const Operation& o = tape.operations[k];
        switch (o.op) {
            case Op::constant: values[k] = static_cast<S>(o.value); break;
            case Op::input: values[k] = input[o.a]; break;
            case Op::previous: values[k] = previous[o.a]; break;
            case Op::derivative: values[k] = derivative[o.a]; break;
            default: values[k] = operated(o.op, values + o.a, o.b < 0 ? nullptr : values + o.b);
        }
    }
    for (std::size_t r = 0; r < tape.results.size(); ++r) results[r] = values[static_cast<std::size_t>(tape.results[r])];
}

}  // namespace algest::plan
