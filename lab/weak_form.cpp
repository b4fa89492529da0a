// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/weak_form.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "algest/dot.hpp"
#include "generator/annihilator.hpp"
#include "generator/delay.hpp"
#include "generator/kernel.hpp"
#include "generator/tape_builder.hpp"
#include "lab/deviations.hpp"
#include "lab/held_parameters.hpp"
#include "lab/noise.hpp"
#include "lab/past.hpp"
#include "lab/polynomial_value.hpp"
#include "lab/roles.hpp"
#include "lab/slope.hpp"

namespace algest::lab {

namespace {

constexpr double digits_of_a_column = 1e-6;   ///< normal equations keep half of the sixteen digits of their columns, less what rounding takes

/// By known times: an equation with a delay that a parameter says has no such form.
std::vector<model::Delay> delays_of(const model::Model& model, const equation::OperatorForm& form) {
    std::vector<model::Delay> out;
    for (const equation::Atom& atom : form.atoms) model::add_delays(model, atom.formula, out);
    return out;
}

/// Every product of the form, sample by sample, not finite where the product is none; delayed forms are one sample late and start at the second row.
std::vector<std::vector<double>> products(const model::Model& model, const Bench& bench, const equation::OperatorForm& form, Rows rows) {
    TapeInputs inputs;
    for (std::size_t s = 0; s < model.signals.size(); ++s) inputs.signal.push_back(static_cast<int>(s));
    std::vector<std::vector<double>> samples = bench.measured;
    for (const model::Delay& d : delays_of(model, form)) {
        const int at = static_cast<int>(samples.size());
        inputs.delay[{d.text, false}] = {plan::Op::input, at, -1, 0};
        inputs.delay[{d.text, true}] = {plan::Op::previous, at, -1, 0};
        const std::vector<double>& prompt = bench.measured[static_cast<std::size_t>(d.signal)];
        samples.push_back(delayed_samples(prompt, samples_ago(exact::nearest(*d.by, plan::Scalar::float64), bench.drive.period), bench.drive.from_rest ? 0.0 : prompt.front()));
    }
    TapeBuilder builder(model, plan::Scalar::float64, inputs);
    for (const equation::Term& term : form.terms) {
        equation::OperatorForm plain = form;
        if (plain.order(term.product) > 0) {
            equation::Atom& atom = plain.atoms[static_cast<std::size_t>(term.product[0].atom)];
            atom.formula = atom.formula->arguments[0];
        }
        builder.result(builder.product(plain, term.product, form.delayed));
    }
    const plan::Tape tape = builder.finish();
    const std::size_t signals = samples.size();
    std::vector<double> here(signals), previous(signals), derivative(signals), values(tape.operations.size()), results(tape.results.size());
    std::vector<std::vector<double>> slope(signals);
    if (form.delayed) {
        const std::vector<double> noise = noise_by_signal(model, bench);
        for (const equation::Atom& atom : form.atoms) {
            if (!atom.differentiates) continue;
            for (const int s : atom.arguments) slope[static_cast<std::size_t>(s)] = slopes(bench.measured[static_cast<std::size_t>(s)], noise[static_cast<std::size_t>(s)], bench.drive.period);
        }
    }
    std::vector<std::vector<double>> out(form.terms.size());
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
        for (std::size_t s = 0; s < signals; ++s) {
            if (samples[s].empty()) continue;
            here[s] = samples[s][row];
            if (row > 0 && !slope[s].empty()) derivative[s] = slope[s][row - 1];   // the form is one sample late
        }
        if (!form.delayed || row > rows.begin) {
            plan::evaluate(tape, here.data(), previous.data(), derivative.data(), values.data(), results.data());
            for (std::size_t k = 0; k < out.size(); ++k) out[k].push_back(results[k]);
        }
        previous = here;
    }
    return out;
}

/// Weights by term over one window, T^-order included, in the samples' own time.
std::vector<std::vector<double>> projections(const model::Model& model, const Bench& bench, const equation::OperatorForm& form, int intervals) {
    std::vector<std::vector<double>> out;
    for (const equation::Term& term : form.terms) {
        const int order = form.order(term.product);
        bool held = !term.product.empty();
        for (const equation::Factor& f : term.product) {
            for (const int s : form.atoms[static_cast<std::size_t>(f.atom)].arguments) held = held && model.signals[static_cast<std::size_t>(s)].hold == plan::Hold::zoh;
        }
        out.push_back(kernel::weights(annihilator::kernel(order, 1, {form.n, 0}), intervals, held ? plan::Hold::zoh : plan::Hold::linear, plan::Quadrature::exact, plan::Scalar::float64));
        const double factor = std::pow(intervals * bench.drive.period, -order);
        for (double& w : out.back()) w *= factor;
    }
    return out;
}

/// d(residual)/d(parameter) of every window.
Eigen::VectorXd weak_slope(const WeakForm& form, const std::vector<double>& parameters, std::size_t p) {
    Eigen::VectorXd c(static_cast<Eigen::Index>(form.coefficients.size()));
    for (std::size_t k = 0; k < form.coefficients.size(); ++k) c[static_cast<Eigen::Index>(k)] = slope_of(form.coefficients[k], parameters, p);
    return form.columns * c;
}

/// One Gauss-Newton step of the parameters `free`, by scaled columns.
void move_to_least_squares(Eigen::MatrixXd slopes, const Eigen::VectorXd& residual, const std::vector<std::size_t>& free, std::vector<double>& parameters) {
    const Eigen::VectorXd size = slopes.colwise().norm();
    for (Eigen::Index f = 0; f < size.size(); ++f) if (size[f] > 0) slopes.col(f) /= size[f];
    const Eigen::VectorXd move = slopes.colPivHouseholderQr().solve(-residual);
    for (std::size_t f = 0; f < free.size(); ++f) {
        const Eigen::Index i = static_cast<Eigen::Index>(f);
        if (size[i] > 0) parameters[free[f]] += move[i] / size[i];
    }
}

struct Windows {
    std::size_t length;   ///< samples of one
    std::size_t stride;
    std::size_t count;
};

Windows windows_of(std::size_t samples, int intervals) {
    const std::size_t length = static_cast<std::size_t>(intervals) + 1;
    const std::size_t stride = static_cast<std::size_t>(std::max(intervals / 2, 1));
    return {length, stride, (samples - length) / stride + 1};
}

bool measured(const Bench& bench, const equation::OperatorForm& form) {
    for (const equation::Atom& atom : form.atoms) for (const int s : atom.arguments) if (bench.measured[static_cast<std::size_t>(s)].empty()) return false;
    return true;
}

bool has_input(const model::Model& model, const equation::OperatorForm& form, const equation::Term& term) {
    const auto is_input = [&](int s) {
        const auto moves_it = [&](const model::Equation& e) { return moved(model, e).signal == s; };
        return model.signals[static_cast<std::size_t>(s)].column != time_column && std::none_of(model.equations.begin(), model.equations.end(), moves_it);
    };
    return std::any_of(term.product.begin(), term.product.end(), [&](const equation::Factor& f) {
        const std::vector<int>& of = form.atoms[static_cast<std::size_t>(f.atom)].arguments;
        return std::any_of(of.begin(), of.end(), is_input);
    });
}

/// The form of an equation that every signal of it is measured for, on rows enough for two windows.
std::optional<equation::OperatorForm> measured_form(const model::Model& model, const Bench& bench, std::size_t equation, Rows rows, int intervals) {
    auto form = form_with_held_parameters(model, equation);
    if (!form || form->n == 0 || rows.size() < 2 * static_cast<std::size_t>(intervals) + 4) return std::nullopt;
    if (!measured(bench, *form)) return std::nullopt;
    return form;
}

}  // namespace

std::vector<int> weak_intervals(const Rows& rows) {
    std::vector<int> out;
    for (const int intervals : {16, 64, 256, 1024}) if (out.empty() || rows.size() > 20 * static_cast<std::size_t>(intervals)) out.push_back(intervals);
    return out;
}

bool has_weak_form(const model::Model& model, const Bench& bench, std::size_t equation) {
    const auto form = form_with_held_parameters(model, equation);
    return form && form->n > 0 && measured(bench, *form);
}

std::vector<double> row_weights(const model::Model& model, std::size_t equation, int intervals) {
    const int n = std::max(moved(model, model.equations[equation]).order, 1);
    return kernel::weights(annihilator::kernel(0, 1, {n, 0}), intervals, plan::Hold::linear, plan::Quadrature::exact, plan::Scalar::float64);
}

std::optional<WeakForm> weak_form(const model::Model& model, const Bench& bench, std::size_t equation, Rows rows, int intervals) {
    const auto form = measured_form(model, bench, equation, rows, intervals);
    if (!form) return std::nullopt;
    WeakForm out;
    out.driven = false;
    out.first_leading = form->leading;
    out.used.assign(model.parameters.size(), false);
    out.leading.assign(model.parameters.size(), false);
    const auto series = products(model, bench, *form, rows);
    const auto weights = projections(model, bench, *form, intervals);
    const Windows windows = windows_of(series[0].size(), intervals);
    out.columns.resize(static_cast<Eigen::Index>(windows.count), static_cast<Eigen::Index>(form->terms.size()));
    for (std::size_t w = 0; w < windows.count; ++w) out.centre.push_back(rows.begin + w * windows.stride + windows.length / 2);
    for (std::size_t k = 0; k < form->terms.size(); ++k) {
        const equation::Term& term = form->terms[k];
        for (std::size_t w = 0; w < windows.count; ++w) {
            out.columns(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(k)) = dot(weights[k].data(), series[k].data() + w * windows.stride, static_cast<int>(windows.length));
        }
        out.coefficients.push_back(term.coefficient);
        for (std::size_t p = 0; p < model.parameters.size(); ++p) {
            out.used[p] = out.used[p] || uses(term.coefficient, p);
            if (static_cast<int>(k) == form->leading) out.leading[p] = uses(term.coefficient, p);
        }
        out.driven = out.driven || is_constant(term.coefficient);
        out.of_input.push_back(has_input(model, *form, term));
    }
    for (Eigen::Index w = 0; w < out.columns.rows(); ++w) {
        if (out.columns.row(w).allFinite()) continue;
        out.columns.row(w).setZero();
        ++out.left_out;
    }
    return out;
}

std::optional<WeakForm> weak_form(const model::Model& model, const std::vector<BenchRows>& stretches, std::size_t equation, int intervals) {
    std::optional<WeakForm> out;
    for (const BenchRows& stretch : stretches) {
        auto form = weak_form(model, *stretch.bench, equation, stretch.rows, intervals);
        if (!form) continue;
        if (!out) {
            out = std::move(form);
            continue;
        }
        const Eigen::Index above = out->columns.rows();
        out->columns.conservativeResize(above + form->columns.rows(), Eigen::NoChange);
        out->columns.bottomRows(form->columns.rows()) = form->columns;
        out->left_out += form->left_out;
    }
    if (out && stretches.size() > 1) out->centre.clear();
    return out;
}

double weak_noise(const model::Model& model, const Bench& bench, std::size_t equation, Rows rows, int intervals, const std::vector<double>& parameters, const std::vector<double>& noise) {
    const auto form = measured_form(model, bench, equation, rows, intervals);
    if (!form) return 0;
    const auto series = products(model, bench, *form, rows);
    const auto weights = projections(model, bench, *form, intervals);
    const Windows windows = windows_of(series[0].size(), intervals);
    double variance = 0;
    Bench moved = bench;
    for (std::size_t s = 0; s < noise.size(); ++s) {
        if (!(noise[s] > 0) || bench.measured[s].empty()) continue;
        for (double& x : moved.measured[s]) x += noise[s];
        const auto beside = products(model, moved, *form, rows);
        moved.measured[s] = bench.measured[s];
        for (std::size_t w = 0; w < windows.count; ++w) {
            for (std::size_t j = 0; j < windows.length; ++j) {
                const std::size_t row = w * windows.stride + j;
                double change = 0;
                for (std::size_t k = 0; k < form->terms.size(); ++k) change += value_of(form->terms[k].coefficient, parameters) * weights[k][j] * (beside[k][row] - series[k][row]);
                if (std::isfinite(change)) variance += change * change;
            }
        }
    }
    return std::sqrt(variance / static_cast<double>(windows.count));
}

WeakEstimate weak_estimate(const model::Model& model, const std::vector<BenchRows>& stretches, int intervals, const std::vector<double>& start) {
    WeakEstimate out{start, std::vector<double>(start.size(), std::numeric_limits<double>::infinity())};
    std::vector<WeakForm> forms;
    std::vector<double> scale;
    std::vector<bool> open(start.size(), false);
    Eigen::Index windows = 0;
    std::vector<std::optional<WeakForm>> all;
    for (const BenchRows& stretch : stretches) {
        for (std::size_t e = 0; e < model.equations.size(); ++e) all.push_back(weak_form(model, *stretch.bench, e, stretch.rows, intervals));
    }
    for (std::optional<WeakForm>& form : all) {
        if (!form) continue;
        const WeakFit own = weak_fit(*form, start);
        if (own.unknowns == 0 || !(own.residual > 0)) continue;
        for (std::size_t p = 0; p < open.size(); ++p) open[p] = open[p] || (form->used[p] && (form->driven || !form->leading[p]));
        scale.push_back(std::sqrt(static_cast<double>(own.windows) / own.residual));   // each equation in units of its own noise
        windows += form->columns.rows();
        forms.push_back(std::move(*form));
    }
    std::vector<std::size_t> free;
    for (std::size_t p = 0; p < open.size(); ++p) if (open[p]) free.push_back(p);
    if (free.empty()) return out;
    Eigen::MatrixXd slopes(windows, static_cast<Eigen::Index>(free.size()));
    Eigen::VectorXd residual(windows);
    const auto linearise = [&] {
        Eigen::Index at = 0;
        for (std::size_t f = 0; f < forms.size(); ++f) {
            const Eigen::Index own = forms[f].columns.rows();
            residual.segment(at, own) = scale[f] * weak_residual(forms[f], out.parameters);
            for (std::size_t k = 0; k < free.size(); ++k) slopes.block(at, static_cast<Eigen::Index>(k), own, 1) = scale[f] * weak_slope(forms[f], out.parameters, free[k]);
            at += own;
        }
    };
    for (int step = 0; step < 3; ++step) {   // exact after one where the equations are linear in their parameters
        linearise();
        move_to_least_squares(slopes, residual, free, out.parameters);
    }
    for (std::size_t p = 0; p < start.size(); ++p) {
        if (!std::isfinite(out.parameters[p])) return {start, out.sd};
        if (model.parameters[p].min) out.parameters[p] = std::max(out.parameters[p], exact::nearest(*model.parameters[p].min, plan::Scalar::float64));
        if (model.parameters[p].max) out.parameters[p] = std::min(out.parameters[p], exact::nearest(*model.parameters[p].max, plan::Scalar::float64));
    }
    linearise();
    const double variance = residual.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(windows - slopes.cols(), 1)) * rows_that_count_as_one(residual.data(), static_cast<std::size_t>(windows));
    const Eigen::VectorXd deviations = deviations_of(slopes.transpose() * slopes, digits_of_a_column);
    for (std::size_t k = 0; k < free.size(); ++k) out.sd[free[k]] = std::sqrt(variance) * deviations[static_cast<Eigen::Index>(k)];
    return out;
}

double driving_size(const WeakForm& form, const std::vector<double>& parameters) {
    Eigen::VectorXd driving = Eigen::VectorXd::Zero(form.columns.rows());
    for (std::size_t k = 0; k < form.coefficients.size(); ++k) {
        if (form.driven ? is_constant(form.coefficients[k]) : static_cast<int>(k) == form.first_leading) driving += value_of(form.coefficients[k], parameters) * form.columns.col(static_cast<Eigen::Index>(k));
    }
    return driving.norm() / std::sqrt(static_cast<double>(driving.size()));
}

double input_size(const WeakForm& form, const std::vector<double>& parameters) {
    Eigen::VectorXd inputs = Eigen::VectorXd::Zero(form.columns.rows());
    for (std::size_t k = 0; k < form.coefficients.size(); ++k) {
        if (form.of_input[k]) inputs += value_of(form.coefficients[k], parameters) * form.columns.col(static_cast<Eigen::Index>(k));
    }
    return inputs.norm() / std::sqrt(static_cast<double>(inputs.size()));
}

Eigen::VectorXd weak_residual(const WeakForm& form, const std::vector<double>& parameters) {
    Eigen::VectorXd c(static_cast<Eigen::Index>(form.coefficients.size()));
    for (std::size_t k = 0; k < form.coefficients.size(); ++k) c[static_cast<Eigen::Index>(k)] = value_of(form.coefficients[k], parameters);
    return form.columns * c;
}

double f_statistic(const WeakFit& before, const WeakFit& after) {
    const double freedom = std::max(after.windows - after.unknowns, 1);
    return (before.residual - after.residual) / (after.residual / freedom) / std::max(after.unknowns - before.unknowns, 1);
}

WeakFit weak_fit(const WeakForm& form, const std::vector<double>& start) {
    std::vector<std::size_t> free;
    for (std::size_t p = 0; p < start.size(); ++p) if (form.used[p] && (form.driven || !form.leading[p])) free.push_back(p);
    WeakFit out{start, 0, static_cast<int>(form.columns.rows()), static_cast<int>(free.size())};
    for (int step = 0; step < 2 && !free.empty(); ++step) {
        const Eigen::VectorXd r = weak_residual(form, out.parameters);
        Eigen::MatrixXd slopes(form.columns.rows(), static_cast<Eigen::Index>(free.size()));
        for (std::size_t f = 0; f < free.size(); ++f) slopes.col(static_cast<Eigen::Index>(f)) = weak_slope(form, out.parameters, free[f]);
        move_to_least_squares(slopes, r, free, out.parameters);
    }
    out.residual = weak_residual(form, out.parameters).squaredNorm();
    return out;
}

}  // namespace algest::lab
