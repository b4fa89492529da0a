// SPDX-License-Identifier: GPL-3.0-or-later
// For any plant, window and samples: rows are linear in the signals; neither an initial condition nor a perturbation of degree < kappa is seen,
// and one of degree kappa is.
#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <fmt/format.h>

#include <string>

#include "tests/plants/estimates.hpp"
#include "tests/properties/rows_of.hpp"

using namespace algest;
using namespace algest::properties;

namespace {

/// Any transfer equation with all coefficients unknown.
std::string any_transfer() {
    const int n = *rc::gen::inRange(1, 4);
    const int m = *rc::gen::inRange(0, n + 1);
    std::string unknowns;
    for (int i = 0; i < n; ++i) unknowns += fmt::format("\"a{}\", ", i);
    for (int i = 0; i <= m; ++i) unknowns += fmt::format("\"b{}\", ", i);
    return fmt::format(R"(format = 1
name = "any"
[sampling]
period = 0.01
window = "{}/100"
[signals]
y = {{ unit = "1" }}
u = {{ unit = "1", hold = "{}" }}
[transfer]
n = {}
m = {}
kappa = {}
unknowns = [{}]
known = {{}}
)",
                       *rc::gen::inRange(12, 41), *rc::gen::element<std::string>("zoh", "linear"), n, m, *rc::gen::inRange(0, 3), unknowns);
}

/// der(y) = b v + w - a y + perturbation, with y and w straight between samples and v held, to the last bit: w carries what y' does not.
struct ExactRun {
    double a, b;
    Columns columns;   ///< y, v, w
};

/// From any y(0), under c0 + c1 t + c2 t^2; all numbers are whole multiples of powers of two. Straight lines hold for degree 1: with c2 the
/// equation is exact at the samples only.
ExactRun exact_run(int samples, double period, const std::vector<int>& c) {
    ExactRun run{*rc::gen::inRange(1, 41) / 8.0, *rc::gen::inRange(1, 41) / 8.0, {{}, whole_numbers(samples, 8), {}}};
    double y = *rc::gen::inRange(-100, 101);
    for (int k = 0; k < samples; ++k) {
        const double t = k * period;
        run.columns[0].push_back(y);
        run.columns[2].push_back(run.a * y - (c[0] + c[1] * t + c[2] * t * t));
        y += period * run.b * run.columns[1][static_cast<std::size_t>(k)];
    }
    return run;
}

plan::Plan exact_plan(int kappa) {
    return plants::plan_of(fmt::format(R"(format = 1
name = "exact"
[sampling]
period = 0.015625
window = "{}/64"
[signals]
y = {{ unit = "1" }}
v = {{ unit = "1", hold = "zoh" }}
w = {{ unit = "1/s" }}
[parameters]
a = {{ unit = "1/s", initial = 1 }}
b = {{ unit = "1/s", initial = 1 }}
[[equation]]
name = "exact"
ode = "der(y) = b*v + w - a*y"
kappa = {}
)",
                                       *rc::gen::inRange(12, 41), kappa));
}

struct Residuals {
    Eigen::ArrayXd found;
    Eigen::ArrayXd rounded;   ///< what rounding may leave
};

Residuals residuals(const plan::Plan& plan, const ExactRun& run) {
    Eigen::VectorXd theta(static_cast<Eigen::Index>(plan.lumped.size()));
    for (std::size_t l = 0; l < plan.lumped.size(); ++l) {
        RC_ASSERT(plan.lumped[l].meaning == "a" || plan.lumped[l].meaning == "b");
        theta(static_cast<Eigen::Index>(l)) = plan.lumped[l].meaning == "a" ? run.a : run.b;
    }
    const lab::StackedRows rows = rows_of(plan, run.columns), sizes = magnitudes(plan, run.columns);
    return {(rows.p * theta - rows.q).array().abs(), rounding(plan) * (sizes.p * theta + sizes.q.cwiseAbs()).array()};
}

}  // namespace

TEST_CASE("properties of rows: linear in the signals") {
    rc::prop("rows of a f + b g", [] {
        const plan::Plan plan = plants::plan_of(any_transfer());
        const double a = *rc::gen::inRange(-9, 10), b = *rc::gen::inRange(-9, 10);
        Columns f, g, both;
        for (std::size_t s = 0; s < plan.inputs.size(); ++s) {
            f.push_back(whole_numbers(plan.samples() + 2, 1000));
            g.push_back(whole_numbers(plan.samples() + 2, 1000));
            both.emplace_back();
            for (std::size_t k = 0; k < f[s].size(); ++k) both[s].push_back(a * f[s][k] + b * g[s][k]);
        }
        const lab::StackedRows of_f = rows_of(plan, f), of_g = rows_of(plan, g), found = rows_of(plan, both);
        const lab::StackedRows size_f = magnitudes(plan, f), size_g = magnitudes(plan, g);
        // each of the three roundings is that of sums of these magnitudes
        const double part = 2 * rounding(plan);
        RC_ASSERT(((found.p - a * of_f.p - b * of_g.p).array().abs() <= part * (std::abs(a) * size_f.p + std::abs(b) * size_g.p).array().abs()).all());
        RC_ASSERT(((found.q - a * of_f.q - b * of_g.q).array().abs() <= part * (std::abs(a) * size_f.q + std::abs(b) * size_g.q).array().abs()).all());
        RC_ASSERT(of_f.p.array().abs().maxCoeff() > 0.0);
    });
}

TEST_CASE("properties of rows: initial conditions and perturbations of degree < kappa leave no trace") {
    rc::prop("the equation holds in every row, whatever y(0), c0 and c1", [] {
        const int kappa = *rc::gen::inRange(0, 3);
        const plan::Plan plan = exact_plan(kappa);
        const int c0 = *rc::gen::inRange(-100, 101), c1 = *rc::gen::inRange(-100, 101);
        const Residuals r = residuals(plan, exact_run(plan.samples() + 20, plan.period, {kappa > 0 ? c0 : 0, kappa > 1 ? c1 : 0, 0}));
        RC_ASSERT((r.found <= r.rounded).all());
    });
}

TEST_CASE("properties of rows: a perturbation of degree kappa is seen") {
    rc::prop("no row holds", [] {
        const int kappa = *rc::gen::inRange(0, 3);
        const plan::Plan plan = exact_plan(kappa);
        std::vector<int> c(3);
        c[static_cast<std::size_t>(kappa)] = *rc::gen::inRange(1, 101);
        const Residuals r = residuals(plan, exact_run(plan.samples() + 20, plan.period, c));
        RC_ASSERT((r.found > 100 * r.rounded).all());
    });
}
