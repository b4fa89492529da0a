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

/// Evaluates a tape. `input`, `previous`, `derivative`: arrays over the inputs (unused ones may be null);
/// `values`: scratch, one per operation; `results`: one per result. Cost: one operation each. Total: never throws.
template <class S>
inline void evaluate(const Tape& tape, const S* input, const S* previous, const S* derivative, S* values, S* results) {
    for (std::size_t k = 0; k < tape.operations.size(); ++k) {
        const Operation& o = tape.operations[k];
        S& v = values[k];
        switch (o.op) {
            case Op::constant: v = static_cast<S>(o.value); break;
            case Op::input: v = input[o.a]; break;
            case Op::previous: v = previous[o.a]; break;
            case Op::derivative: v = derivative[o.a]; break;
            case Op::neg: v = -values[o.a]; break;
            case Op::add: v = values[o.a] + values[o.b]; break;
            case Op::sub: v = values[o.a] - values[o.b]; break;
            case Op::mul: v = values[o.a] * values[o.b]; break;
            case Op::div: v = values[o.a] / values[o.b]; break;
            case Op::sqrt: v = std::sqrt(values[o.a]); break;
            case Op::exp: v = std::exp(values[o.a]); break;
            case Op::log: v = std::log(values[o.a]); break;
            case Op::sin: v = std::sin(values[o.a]); break;
            case Op::cos: v = std::cos(values[o.a]); break;
            case Op::tan: v = std::tan(values[o.a]); break;
            case Op::abs: v = std::abs(values[o.a]); break;
            case Op::sgn: v = algest::sgn(values[o.a]); break;
            case Op::min: v = algest::smaller(values[o.a], values[o.b]); break;
            case Op::max: v = algest::larger(values[o.a], values[o.b]); break;
            case Op::pow: v = std::pow(values[o.a], values[o.b]); break;
        }
    }
    for (std::size_t r = 0; r < tape.results.size(); ++r) results[r] = values[static_cast<std::size_t>(tape.results[r])];
}

}  // namespace algest::plan
