// SPDX-License-Identifier: GPL-3.0-or-later
// Plans made by hand, small enough that their estimates follow on paper. Period 1/4 s.
#pragma once
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "generator/plan.hpp"

namespace algest::test {

inline plan::Input input(const std::string& name, const std::string& unit, bool differentiated = false) {
    plan::Input out{};
    out.name = name;
    out.unit = unit;
    out.column = name;
    out.min = -std::numeric_limits<double>::infinity();
    out.max = std::numeric_limits<double>::infinity();
    out.differentiated = differentiated;
    return out;
}

inline plan::Table table(std::vector<double> weights) {
    plan::Table out{};
    out.weights = std::move(weights);
    return out;
}

inline plan::RowTerm term(int lumped, int signal, int table, double factor) {
    plan::RowTerm out{};
    out.lumped = lumped;
    out.signal = signal;
    out.table = table;
    out.factor = factor;
    return out;
}

inline plan::Row row(std::vector<plan::RowTerm> terms) {
    plan::Row out{};
    out.terms = std::move(terms);
    return out;
}

inline plan::Parameter parameter(const std::string& name, const std::string& unit, double initial) {
    plan::Parameter out{};
    out.name = name;
    out.unit = unit;
    out.initial = initial;
    return out;
}

inline plan::Plan empty_plan() {
    plan::Plan out{};
    out.name = "by_hand";
    out.period = 0.25;
    out.rate = 4.0;
    out.keep = 1.0;
    out.condition_limit = 1e6;
    return out;
}

/// G mean(y) = mean(u) over three samples, weights 1/4, 1/2, 1/4; parameters G (1/ohm) and R = 1/G (ohm).
inline plan::Plan conductance() {
    using plan::Op;
    plan::Plan out = empty_plan();
    out.intervals = 2;
    out.inputs = {input("y", "V"), input("u", "A")};
    out.window_signals.resize(2);
    out.signals = {{{Op::input, 0, 0, 0.0}, {Op::input, 1, 0, 0.0}}, {0, 1}};
    out.tables = {table({0.25, 0.5, 0.25})};
    out.rows = {row({term(0, 0, 0, 1.0), term(-1, 1, 0, 1.0)})};
    out.lumped.resize(1);
    out.parameters = {parameter("G", "1/ohm", 7.0), parameter("R", "ohm", 8.0)};
    out.parameter_map = {{{Op::input, 0, 0, 0.0}, {Op::constant, 0, 0, 1.0}, {Op::div, 1, 0, 0.0}}, {0, 2}};
    out.solve = Solve::square;
    return out;
}

/// G y + c = u on single windows of two samples, weights 1/2, 1/2; the offset c stands on the constant 1.
inline plan::Plan line(Solve solve, int instants) {
    using plan::Op;
    plan::Plan out = empty_plan();
    out.intervals = 1;
    out.inputs = {input("y", "V"), input("u", "A")};
    out.window_signals.resize(2);
    out.signals = {{{Op::input, 0, 0, 0.0}, {Op::input, 1, 0, 0.0}}, {0, 1}};
    out.tables = {table({0.5, 0.5})};
    out.rows = {row({term(0, 0, 0, 1.0), term(1, -1, -1, 1.0), term(-1, 1, 0, 1.0)})};
    out.lumped.resize(2);
    out.parameters = {parameter("G", "1/ohm", 0.0), parameter("c", "A", 0.0)};
    out.parameter_map = {{{Op::input, 0, 0, 0.0}, {Op::input, 1, 0, 0.0}}, {0, 1}};
    out.solve = solve;
    out.solve_instants = instants;
    return out;
}

/// g dq/dt = f, one sample late, over two samples, weights 1/2, 1/2.
inline plan::Plan slope() {
    using plan::Op;
    plan::Plan out = empty_plan();
    out.intervals = 1;
    out.inputs = {input("q", "m", true), input("f", "N")};
    out.window_signals.resize(2);
    for (plan::WindowSignal& s : out.window_signals) s.delayed = true;
    out.signals = {{{Op::derivative, 0, 0, 0.0}, {Op::previous, 1, 0, 0.0}}, {0, 1}};
    out.tables = {table({0.5, 0.5})};
    out.rows = {row({term(0, 0, 0, 1.0), term(-1, 1, 0, 1.0)})};
    out.lumped.resize(1);
    out.parameters = {parameter("g", "N.s/m", -1.0)};
    out.parameter_map = {{{Op::input, 0, 0, 0.0}}, {0}};
    out.solve = Solve::square;
    return out;
}

}  // namespace algest::test
