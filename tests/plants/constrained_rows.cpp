// SPDX-License-Identifier: GPL-3.0-or-later
// Elimination on the rows of annihilators: more products of parameters than parameters, refused by the other solves.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

/// Two lags in series; the second one's gain is a parameter of the first, or of both alike.
std::string lags(const std::string& gain, const std::string& solve) {
    return "format = 1\nname = \"lags\"\n[sampling]\nperiod = 1e-3\nwindow = 0.6\n[signals]\ny = { unit = \"V\" }\nu = { unit = \"V\" }\n"
           "[constants]\ns = { value = 1, unit = \"s\" }\n"
           "[parameters]\na = { unit = \"1/s\", initial = 4 }\nb = { unit = \"1/s\", initial = 16 }\n"
           "[[equation]]\nname = \"lags\"\node = \"der(y,2) + (a+b)*der(y) + a*b*y = " + gain + "*u\"\n[estimator]\nsolve = \"" + solve + "\"\n";
}

constexpr double a = 3, b = 20, w = 7;

/// y'' + (a+b) y' + ab y = g u, u = sin(w t), from rest: the solution by partial fractions.
std::vector<std::vector<double>> response(double g, int count) {
    const double p = a * b - w * w, q = (a + b) * w;
    const double A = g * p / (p * p + q * q), B = -g * q / (p * p + q * q);   // A sin + B cos
    const double C = (b * B + w * A) / (a - b), D = -B - C;                    // C e^-at + D e^-bt: y(0) = y'(0) = 0
    std::vector<std::vector<double>> out;
    for (int k = 0; k < count; ++k) {
        const double t = 1e-3 * k;
        out.push_back({A * std::sin(w * t) + B * std::cos(w * t) + C * std::exp(-a * t) + D * std::exp(-b * t), std::sin(w * t)});
    }
    return out;
}

}  // namespace

TEST_CASE("the response of the test obeys its equation") {
    const auto y = response(a, 3);
    // Second difference at the first sample: y'' there is g u' t = a w t to the first order.
    CHECK((y[2][0] - 2 * y[1][0] + y[0][0]) / 1e-6 == Approx(a * std::sin(w * 1e-3)).epsilon(0.05));
    CHECK(y[0][0] == Approx(0).margin(1e-15));
}

TEST_CASE("elimination: a+b, a*b and a are three unknowns of two parameters") {
    const plan::Plan plan = plan_of(lags("a/s", "elimination"));
    const auto all = estimates(plan, response(a, 1500));
    const Estimate& last = all.back();
    REQUIRE(last.status == Status::ok);
    // The linear hold of a sine of 7 rad/s at 1 kHz is (w T)^2/12 = 4e-6 off; the rows' condition multiplies it.
    CHECK(relative_error(last.parameters[0], a) < 1e-3);
    CHECK(relative_error(last.parameters[1], b) < 1e-3);
}

TEST_CASE("elimination: what is symmetric in two parameters fits two answers, and none is given") {
    const plan::Plan plan = plan_of(lags("a*b", "elimination"));
    for (const Estimate& e : estimates(plan, response(a * b, 1500))) CHECK((e.status == Status::filling || e.status == Status::singular));
}

TEST_CASE("the other solves refuse what elimination takes, and name the term") {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    CHECK_FALSE(generator::plan_from_model(folder.write("model.toml", lags("a/s", "least_squares")), {plan::Scalar::float64, ""}, diagnostics));
    bool named = false;
    for (const Diagnostic& d : diagnostics.sorted()) named = named || d.text().find("solve = \"elimination\"") != std::string::npos;
    CHECK(named);
}
