// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/engine.hpp"

#include <algorithm>
#include <string>

#include "generator/kernel.hpp"
#include "generator/moment_rounding.hpp"
#include "generator/window_polynomial.hpp"

namespace algest::generator {

namespace {

int degree_of(const plan::Plan& plan) {
    std::size_t count = 1;
    for (const plan::Table& t : plan.tables) count = std::max(count, t.kernel.size());
    return static_cast<int>(count) - 1;
}

plan::Accumulators accumulators(const model::Model& model, const plan::Plan& plan) {
    return plan.scalar == plan::Scalar::float32 ? model.estimator.accumulators : plan::Accumulators::float64;
}

const std::string& wanted(const model::Model& model, const std::string& asked) { return asked.empty() ? model.estimator.engine : asked; }

/// Why moments will not do; empty: they will.
std::string obstacle(const model::Model& model, const plan::Plan& plan) {
    const model::Estimator& e = model.estimator;
    if (e.functional != model::Functional::annihilator) return "only the annihilator has polynomial kernels on windows";
    const bool alternating = plan.quadrature == plan::Quadrature::simpson &&
                             std::any_of(plan.tables.begin(), plan.tables.end(), [](const plan::Table& t) { return t.hold == plan::Hold::linear; });
    if (alternating) return "Simpson's weights alternate";
    if (degree_of(plan) > largest_moment_degree) return "a kernel is of degree " + std::to_string(degree_of(plan)) + ", above " + std::to_string(largest_moment_degree);
    if (e.whiten) return "whitening needs whole windows";
    if (e.limits_deviation()) return "deviation_limit needs whole windows";
    if (e.uncertainty.value_or(false)) return "uncertainty() needs whole windows";
    if (model.growing && plan.quadrature != plan::Quadrature::exact) return "growing windows need the exact quadrature";
    if (model.growing && !plan.perturbation.empty()) return "a growing window gives no perturbation";
    if (model.growing && accumulators(model, plan) == plan::Accumulators::twofold) return "growing windows in single precision need accumulators = \"double\"";
    return "";
}

std::vector<int> degrees_of_signals(const plan::Plan& plan) {
    std::vector<int> out(plan.window_signals.size(), 0);
    for (const std::vector<plan::Row>* rows : {&plan.rows, &plan.perturbation}) {
        for (const plan::Row& row : *rows) {
            for (const plan::RowTerm& term : row.terms) {
                if (term.signal < 0) continue;
                int& degree = out[static_cast<std::size_t>(term.signal)];
                degree = std::max(degree, static_cast<int>(plan.tables[static_cast<std::size_t>(term.table)].kernel.size()) - 1);
            }
        }
    }
    return out;
}

void set_growing(const kernel::Coefficients& k, plan::Hold hold, int degree, plan::MomentTable& out) {
    const kernel::GrowingPolynomial p = kernel::growing_polynomial(k, hold);
    const std::size_t count = static_cast<std::size_t>(degree) + 1;
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = 0; i < count; ++i) {
            const bool there = i < p.by_power.size() && j < p.by_power[i].size();
            out.growing.push_back(there ? exact::nearest(p.by_power[i][j], plan::Scalar::float64) : 0.0);
        }
    }
    for (std::size_t i = 0; i < count; ++i) out.growing_newest.push_back(i < p.newest.size() ? exact::nearest(p.newest[i], plan::Scalar::float64) : 0.0);
}

plan::MomentTable moment_table(const plan::Table& table, const plan::Plan& plan, const plan::Moments& moments, const exact::Rational& step) {
    const kernel::Coefficients k = kernel::coefficients(table.kernel);
    kernel::WindowPolynomial p = kernel::window_polynomial(k, plan.intervals, table.hold, plan.quadrature, step);
    const exact::Rational gain = rounding_gain(p, plan.intervals, step, plan.scalar, moments.accumulators);
    p.coefficients.resize(static_cast<std::size_t>(moments.degree) + 1, 0);
    plan::MomentTable out;
    for (const exact::Rational& c : p.coefficients) {
        if (moments.accumulators == plan::Accumulators::float64) {
            out.coefficients.push_back(exact::nearest(c, plan::Scalar::float64));
        } else {
            const exact::TwoParts parts = exact::nearest_two(c, plan.scalar);
            out.coefficients.push_back(parts.high);
            out.rests.push_back(parts.low);
        }
    }
    out.degree = static_cast<int>(table.kernel.size()) - 1;
    out.derivative = table.derivative;
    if (moments.shortest > 0) set_growing(k, table.hold, moments.degree, out);
    out.oldest = exact::nearest(p.oldest, plan.scalar);
    out.newest = exact::nearest(p.newest, plan.scalar);
    out.gain = exact::nearest(gain, plan.scalar);
    out.of_one = exact::nearest(kernel::integral(k, plan.intervals, table.hold, plan.quadrature), plan.scalar);
    return out;
}

}  // namespace

bool growing_serves(const model::Model& model, Diagnostics& diagnostics) {
    if (!model.growing || model.estimator.functional == model::Functional::annihilator) return true;
    diagnostics.error(model.path, model.growing_at, "growing windows are for the annihilator", "leave growing out");
    return false;
}

std::optional<plan::Moments> moments(const model::Model& model, const std::string& asked, plan::Plan& plan, Diagnostics& diagnostics) {
    if (wanted(model, asked) != "moments") {
        if (model.growing) diagnostics.error(model.path, model.growing_at, "a growing window needs engine moments", "write engine = \"moments\" under [estimator], or leave growing out");
        return std::nullopt;
    }

    const std::string why = obstacle(model, plan);
    if (!why.empty()) {
        if (!model.growing) plan.notes.push_back("engine fir instead of moments: " + why);
        else diagnostics.error(model.path, model.growing_at, "a growing window needs engine moments, and " + why, "leave growing out, or what stands against it");
        return std::nullopt;
    }
    const bool noisy = std::any_of(model.signals.begin(), model.signals.end(), [](const model::Signal& s) { return s.deviation().has_value(); });
    if (noisy && plan.solve != algest::Solve::least_squares && model.estimator.uncertainty.value_or(true)) {
        plan.notes.push_back("no uncertainty(): it reads whole windows, which engine moments does not keep");
    }
    plan::Moments out;
    out.degree = degree_of(plan);
    out.degrees = degrees_of_signals(plan);
    const exact::Rational step = kernel::coordinate_step(plan.intervals);
    out.step = exact::nearest(step, plan.scalar);
    out.accumulators = accumulators(model, plan);
    if (model.growing) out.shortest = std::min(plan.samples(), out.degree + 2);
    for (const plan::Table& t : plan.tables) out.tables.push_back(moment_table(t, plan, out, step));
    return out;
}

}  // namespace algest::generator
