// SPDX-License-Identifier: GPL-3.0-or-later
// The per-sample procedure, on plans whose estimates follow on paper.
#include "lab/host_estimator.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <limits>

#include "tests/lab/plans.hpp"

using namespace algest;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

template <class S>
Status step(lab::HostEstimator<S>& estimator, S a, S b) {
    const std::array<S, 2> sample{a, b};
    return estimator.step(sample.data());
}

}  // namespace

TEST_CASE("functionals are shared, in order of first use, and terms are grouped by functional in order of rows") {
    plan::Plan p = test::conductance();
    p.lumped.resize(2);
    p.tables = {test::table({1, 2, 3}), test::table({4, 5, 6})};
    p.rows = {
        test::row({test::term(0, 1, 1, 10), test::term(1, -1, -1, 11), test::term(-1, 0, 0, 12)}),
        test::row({test::term(-1, 1, 1, 13), test::term(0, 0, 1, 14), test::term(1, -1, -1, 15), test::term(1, 1, 1, 16)})};
    const auto data = plan::make_blueprint<double>(p);
    const auto b = data.view();
    CHECK(data.tables == std::vector<double>{1, 2, 3, 4, 5, 6});
    CHECK(b.rows.samples == 3);
    CHECK(b.rows.unknowns == 2);
    struct Expected {
        int table, signal, first, terms;
    };
    const std::array<Expected, 4> functionals{{{1, 1, 0, 3}, {no_table, 0, 3, 2}, {0, 0, 5, 1}, {1, 0, 6, 1}}};
    REQUIRE(b.rows.functionals.size == 4);
    for (int f = 0; f < 4; ++f) {
        const Expected& e = functionals[static_cast<std::size_t>(f)];
        CHECK(b.rows.functionals[f].table == e.table);
        CHECK(b.rows.functionals[f].signal == e.signal);
        CHECK(b.rows.functionals[f].first_term == e.first);
        CHECK(b.rows.functionals[f].terms == e.terms);
    }
    struct ExpectedTerm {
        int row, column;
        double factor;
    };
    const std::array<ExpectedTerm, 7> terms{
        {{0, 0, 10}, {1, 2, 13}, {1, 1, 16}, {0, 1, 11}, {1, 1, 15}, {0, 2, 12}, {1, 0, 14}}};
    REQUIRE(b.rows.terms.size == 7);
    for (int k = 0; k < 7; ++k) {
        const ExpectedTerm& e = terms[static_cast<std::size_t>(k)];
        CHECK(b.rows.terms[k].row == e.row);
        CHECK(b.rows.terms[k].column == e.column);
        CHECK(b.rows.terms[k].factor == e.factor);
    }
}

TEST_CASE("a window fills, then every sample gives an estimate") {
    const plan::Plan p = test::conductance();
    lab::HostEstimator<double> e(p);
    CHECK(e.parameters() == std::vector<double>{7.0, 8.0});
    CHECK(step(e, 2.0, 6.0) == Status::filling);
    CHECK(step(e, 4.0, 12.0) == Status::filling);
    CHECK(e.parameters() == std::vector<double>{7.0, 8.0});
    CHECK(std::isinf(e.condition()));
    CHECK(step(e, 6.0, 18.0) == Status::ok);  // mean u 12, mean y 4
    CHECK(e.parameters() == std::vector<double>{3.0, 1.0 / 3.0});
    CHECK(e.condition() == 1.0);              // one unknown
    CHECK(step(e, 8.0, -8.0) == Status::ok);  // means 3 + 9 - 2 = 10 and 1 + 3 + 2 = 6
    CHECK(e.parameters()[0] == Approx(10.0 / 6.0).epsilon(1e-15));
    e.reset();
    CHECK(e.status() == Status::filling);
    CHECK(e.parameters() == std::vector<double>{7.0, 8.0});
    CHECK(step(e, 2.0, 6.0) == Status::filling);
}

TEST_CASE("a sample that is not finite or outside its limits is refused, and the window starts anew") {
    plan::Plan p = test::conductance();
    p.inputs[1].min = -20.0;
    p.inputs[1].max = 20.0;
    const double bad = GENERATE(values({nan_value, std::numeric_limits<double>::infinity(), -20.5, 21.0}));
    lab::HostEstimator<double> e(p);
    for (int k = 0; k < 5; ++k) step(e, 2.0, 20.0);
    REQUIRE(e.parameters()[0] == 10.0);
    CHECK(step(e, 2.0, bad) == Status::rejected);
    CHECK(e.parameters()[0] == 10.0);
    CHECK(step(e, 2.0, 4.0) == Status::filling);
    CHECK(step(e, 2.0, 4.0) == Status::filling);
    CHECK(e.parameters()[0] == 10.0);
    CHECK(step(e, 2.0, 4.0) == Status::ok);  // nothing of before the refusal is left
    CHECK(e.parameters()[0] == 2.0);
}

TEST_CASE("a sample whose computed signal is not finite is refused") {
    plan::Plan p = test::conductance();
    p.signals = {{{plan::Op::input, 0, 0, 0.0}, {plan::Op::input, 1, 0, 0.0}, {plan::Op::log, 1, 0, 0.0}}, {0, 2}};
    lab::HostEstimator<double> e(p);
    for (int k = 0; k < 3; ++k) step(e, 2.0, std::exp(4.0));
    CHECK(e.parameters()[0] == Approx(2.0).epsilon(1e-14));
    CHECK(step(e, 2.0, -1.0) == Status::rejected);
    CHECK(step(e, 2.0, 1.0) == Status::filling);
}

TEST_CASE("what the rows or the parameter map cannot tell is singular, and the last values are held") {
    const plan::Plan p = test::conductance();
    lab::HostEstimator<double> e(p);
    for (int k = 0; k < 3; ++k) step(e, 2.0, 6.0);
    REQUIRE(e.parameters()[0] == 3.0);
    step(e, 0.0, 6.0);
    step(e, 0.0, 6.0);
    CHECK(step(e, 0.0, 6.0) == Status::singular);                               // no y, no conductance
    CHECK(e.parameters() == std::vector<double>{1.0 * 6.0 / 0.5, 1.0 / 12.0});  // of the window 2, 0, 0: mean y 1/2
    for (int k = 0; k < 3; ++k) step(e, 2.0, 0.0);
    CHECK(e.status() == Status::singular);  // G = 0: R is not finite
    CHECK(e.parameters()[0] != 0.0);
}

TEST_CASE("the offset on the constant 1, by least squares and by S(t)") {
    // u = 2 y + 5
    const plan::Plan all_rows = test::line(Solve::least_squares, 0);
    lab::HostEstimator<double> least_squares(all_rows);
    CHECK(step(least_squares, 1.0, 7.0) == Status::filling);
    CHECK(step(least_squares, 2.0, 9.0) == Status::singular);  // one row, two unknowns
    CHECK(step(least_squares, 4.0, 13.0) == Status::ok);
    CHECK(least_squares.parameters()[0] == Approx(2.0).epsilon(1e-13));
    CHECK(least_squares.parameters()[1] == Approx(5.0).epsilon(1e-13));

    const plan::Plan window = test::line(Solve::robust, 3);
    lab::HostEstimator<double> robust(window);
    for (const double y : {1.0, 2.0, 4.0}) CHECK(step(robust, y, 2.0 * y + 5.0) == Status::filling);
    CHECK(step(robust, 3.0, 11.0) == Status::ok);  // windows end at samples 2, 3, 4
    CHECK(robust.parameters()[0] == Approx(2.0).epsilon(1e-13));
    CHECK(robust.parameters()[1] == Approx(5.0).epsilon(1e-13));
}

TEST_CASE("a derivative comes one sample late, and everything else in its rows with it") {
    const plan::Plan p = test::slope();
    lab::HostEstimator<double> e(p);
    CHECK(step(e, 0.0, 0.0) == Status::filling);  // remembered only
    CHECK(step(e, 1.0, 4.0) == Status::filling);  // dq/dt = 4 at the sample before, f = 0 there
    CHECK(step(e, 2.0, 8.0) == Status::ok);       // f = 0, 4; dq/dt = 4, 4
    CHECK(e.parameters()[0] == 0.5);
    CHECK(step(e, 3.0, 12.0) == Status::ok);  // f = 4, 8
    CHECK(e.parameters()[0] == 1.5);
    CHECK(step(e, nan_value, 12.0) == Status::rejected);
    CHECK(step(e, 0.0, 6.0) == Status::filling);  // remembered only
    CHECK(step(e, 1.0, 6.0) == Status::filling);
    // The parabola through the state (0, slope 1) nearest to 1 and 4: 1 + 2 a of slope at the first, a = 4 * 2 / 17.
    CHECK(step(e, 4.0, 0.0) == Status::ok);
    CHECK(e.parameters()[0] == Approx(12.0 / (4.0 + 4.0 * (1.0 + 16.0 / 17.0))).epsilon(1e-15));
}

TEST_CASE("in float every operation is one of float") {
    const plan::Plan p = test::conductance();
    lab::HostEstimator<float> e(p);
    for (int k = 0; k < 3; ++k) step(e, 2.0F, 6.0F);
    CHECK(e.parameters() == std::vector<float>{3.0F, 1.0F / 3.0F});
}
