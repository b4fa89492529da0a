// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/bound_tape.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <cstring>

using namespace algest;
using plan::Op;

namespace {

constexpr int inputs = 4;

/// A tape that reads every input, then mixes what it has by random operations of every kind; each value is a result.
plan::Tape random_tape() {
    plan::Tape out;
    for (int k = 0; k < inputs; ++k) out.operations.push_back({Op::input, k, -1, 0.0});
    out.operations.push_back({Op::constant, -1, -1, 0.75});
    for (int k = 0; k < 40; ++k) {
        const Op op = static_cast<Op>(*rc::gen::inRange(static_cast<int>(Op::neg), static_cast<int>(Op::pow) + 1));
        const int have = static_cast<int>(out.operations.size());
        const bool two = op == Op::add || op == Op::sub || op == Op::mul || op == Op::div || op == Op::min || op == Op::max || op == Op::pow;
        out.operations.push_back({op, *rc::gen::inRange(0, have), two ? *rc::gen::inRange(0, have) : -1, 0.0});
    }
    for (std::size_t k = 0; k < out.operations.size(); ++k) out.results.push_back(static_cast<int>(k));
    return out;
}

}  // namespace

TEST_CASE("a bound tape gives what the tape gives, to the last bit, while what is not fixed moves") {
    rc::prop("of any operations", [] {
        const plan::Tape tape = random_tape();
        std::vector<double> in = {0.5, -1.25, 3.0, 0.1};
        const std::vector<bool> fixed = {*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(), true, false};
        lab::BoundTape bound(tape, in, fixed);
        std::vector<double> found(tape.results.size()), expected(tape.results.size()), values(tape.operations.size());
        for (int look = 0; look < 3; ++look) {
            for (std::size_t k = 0; k < in.size(); ++k) if (!fixed[k]) in[k] += 0.37;
            bound.evaluate(found.data());
            plan::evaluate<double>(tape, in.data(), nullptr, nullptr, values.data(), expected.data());
            for (std::size_t r = 0; r < found.size(); ++r) {
                RC_ASSERT(std::memcmp(&found[r], &expected[r], sizeof(double)) == 0 || (std::isnan(found[r]) && std::isnan(expected[r])));
            }
        }
    });
}

TEST_CASE("a bound tape leaves out what stands still: a value that it says is fixed is not looked at again") {
    // (p + 1) * x, p fixed
    const plan::Tape tape = {{{Op::input, 0, -1, 0}, {Op::constant, -1, -1, 1.0}, {Op::add, 0, 1, 0}, {Op::input, 1, -1, 0}, {Op::mul, 2, 3, 0}}, {4}};
    std::vector<double> in = {2.0, 5.0};
    lab::BoundTape bound(tape, in, {true, false});
    double result = 0;
    in = {100.0, 7.0};
    bound.evaluate(&result);
    CHECK(result == 21.0);
    CHECK_THROWS_AS(lab::BoundTape({{{Op::previous, 0, -1, 0}}, {0}}, in, {true, false}), std::logic_error);
}
