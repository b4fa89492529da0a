// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/weak_form.hpp"

#include <cmath>
#include <set>

#include "algest/dot.hpp"
#include "algest/parabola_filter.hpp"
#include "generator/annihilator.hpp"
#include "generator/kernel.hpp"
#include "generator/tape_builder.hpp"

namespace algest::lab {

namespace {

double value_of(const Polynomial& p, const std::vector<double>& parameters) {
    double out = 0;
    for (const auto& [exponents, coefficient] : p) {
        double term = exact::nearest(coefficient, plan::Scalar::float64);
        for (std::size_t k = 0; k < exponents.size(); ++k) for (int e = 0; e < exponents[k]; ++e) term *= parameters[k];
        out += term;
    }
    return out;
}

double slope_of(const Polynomial& p, const std::vector<double>& parameters, std::size_t k) {
    double out = 0;
    for (const auto& [exponents, coefficient] : p) {
        if (exponents[k] == 0) continue;
        double term = exact::nearest(coefficient, plan::Scalar::float64) * exponents[k];
        for (std::size_t q = 0; q < exponents.size(); ++q) {
            const int times = exponents[q] - (q == k ? 1 : 0);
            for (int e = 0; e < times; ++e) term *= parameters[q];
        }
        out += term;
    }
    return out;
}

/// Every product of the form, sample by sample; delayed forms are one sample late and start at the second row.
std::vector<std::vector<double>> products(const model::Model& model, const Bench& bench, const equation::OperatorForm& form, Rows rows) {
    std::vector<int> inputs(model.signals.size());
    for (std::size_t s = 0; s < inputs.size(); ++s) inputs[s] = static_cast<int>(s);
    TapeBuilder builder(model, plan::Scalar::float64, {inputs});
    for (const equation::Term& term : form.terms) {
        equation::OperatorForm plain = form;
        if (plain.order(term.product) > 0) {
            equation::Atom& atom = plain.atoms[static_cast<std::size_t>(term.product[0].atom)];
            atom.formula = atom.formula->arguments[0];
        }
        builder.result(builder.product(plain, term.product, form.delayed));
    }
    const plan::Tape tape = builder.finish();
    const std::size_t signals = model.signals.size();
    std::vector<double> here(signals), previous(signals), derivative(signals), values(tape.operations.size()), results(tape.results.size());
    std::vector<ParabolaFilter<double>> filters(signals);
    std::vector<std::vector<double>> out(form.terms.size());
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
        for (std::size_t s = 0; s < signals; ++s) {
            if (bench.measured[s].empty()) continue;
            here[s] = bench.measured[s][row];
            if (row == rows.begin + 1) filters[s].start(previous[s], here[s]);
            if (row > rows.begin + 1) filters[s].advance(previous[s], here[s]);
            derivative[s] = filters[s].slope / bench.drive.period;
        }
        if (!form.delayed || row > rows.begin) {
            plan::evaluate(tape, here.data(), previous.data(), derivative.data(), values.data(), results.data());
            for (std::size_t k = 0; k < out.size(); ++k) out[k].push_back(std::isfinite(results[k]) ? results[k] : 0.0);
        }
        previous = here;
    }
    return out;
}

}  // namespace

std::optional<WeakForm> weak_form(const model::Model& model, const Bench& bench, std::size_t equation, Rows rows, int intervals) {
    Diagnostics quiet;
    const auto form = equation::operator_form(model, model.equations[equation], quiet);
    if (!form || form->terms.empty() || rows.size() < 2 * static_cast<std::size_t>(intervals) + 4) return std::nullopt;
    for (const equation::Atom& atom : form->atoms) for (const int s : atom.arguments) if (bench.measured[static_cast<std::size_t>(s)].empty()) return std::nullopt;

    WeakForm out;
    out.driven = false;
    out.used.assign(model.parameters.size(), false);
    out.leading.assign(model.parameters.size(), false);
    const auto series = products(model, bench, *form, rows);
    const std::size_t length = static_cast<std::size_t>(intervals) + 1;
    const std::size_t stride = static_cast<std::size_t>(std::max(intervals / 2, 1));
    const std::size_t windows = (series[0].size() - length) / stride + 1;
    out.columns.resize(static_cast<Eigen::Index>(windows), static_cast<Eigen::Index>(form->terms.size()));
    for (std::size_t w = 0; w < windows; ++w) out.centre.push_back(rows.begin + w * stride + length / 2);
    for (std::size_t k = 0; k < form->terms.size(); ++k) {
        const equation::Term& term = form->terms[k];
        const int order = form->order(term.product);
        bool held = true;
        for (const equation::Factor& f : term.product) {
            const equation::Atom& atom = form->atoms[static_cast<std::size_t>(f.atom)];
            for (const int s : atom.arguments) held = held && model.signals[static_cast<std::size_t>(s)].hold == plan::Hold::zoh;
        }
        const auto weights = kernel::weights(annihilator::kernel(order, 1, {form->n, 0}), intervals, held && !term.product.empty() ? plan::Hold::zoh : plan::Hold::linear, plan::Quadrature::exact, plan::Scalar::float64);
        const double factor = std::pow(intervals * bench.drive.period, -order);
        for (std::size_t w = 0; w < windows; ++w) {
            out.columns(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(k)) = factor * dot(weights.data(), series[k].data() + w * stride, static_cast<int>(length));
        }
        out.coefficients.push_back(term.coefficient);
        for (std::size_t p = 0; p < model.parameters.size(); ++p) {
            out.used[p] = out.used[p] || uses(term.coefficient, p);
            if (static_cast<int>(k) == form->leading) out.leading[p] = uses(term.coefficient, p);
        }
        out.driven = out.driven || is_constant(term.coefficient);
    }
    return out;
}

Eigen::VectorXd weak_residual(const WeakForm& form, const std::vector<double>& parameters) {
    Eigen::VectorXd c(static_cast<Eigen::Index>(form.coefficients.size()));
    for (std::size_t k = 0; k < form.coefficients.size(); ++k) c[static_cast<Eigen::Index>(k)] = value_of(form.coefficients[k], parameters);
    return form.columns * c;
}

WeakFit weak_fit(const WeakForm& form, const std::vector<double>& start) {
    std::vector<std::size_t> free;
    for (std::size_t p = 0; p < start.size(); ++p) if (form.used[p] && (form.driven || !form.leading[p])) free.push_back(p);
    WeakFit out{start, 0, static_cast<int>(form.columns.rows()), static_cast<int>(free.size())};
    for (int step = 0; step < 2 && !free.empty(); ++step) {
        const Eigen::VectorXd r = weak_residual(form, out.parameters);
        Eigen::MatrixXd slopes(form.columns.rows(), static_cast<Eigen::Index>(free.size()));
        for (std::size_t f = 0; f < free.size(); ++f) {
            Eigen::VectorXd c(static_cast<Eigen::Index>(form.coefficients.size()));
            for (std::size_t k = 0; k < form.coefficients.size(); ++k) c[static_cast<Eigen::Index>(k)] = slope_of(form.coefficients[k], out.parameters, free[f]);
            slopes.col(static_cast<Eigen::Index>(f)) = form.columns * c;
        }
        Eigen::VectorXd size = slopes.colwise().norm();
        for (Eigen::Index f = 0; f < size.size(); ++f) if (size[f] > 0) slopes.col(f) /= size[f];
        const Eigen::VectorXd move = slopes.colPivHouseholderQr().solve(-r);
        for (std::size_t f = 0; f < free.size(); ++f) {
            const Eigen::Index i = static_cast<Eigen::Index>(f);
            if (size[i] > 0) out.parameters[free[f]] += move[i] / size[i];
        }
    }
    out.residual = weak_residual(form, out.parameters).squaredNorm();
    return out;
}

}  // namespace algest::lab
