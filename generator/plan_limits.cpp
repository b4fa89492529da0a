// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/plan_limits.hpp"

#include <algorithm>
#include <cmath>

#include "generator/elimination_data.hpp"

namespace algest::generator {

namespace {

bool numbers_fit_the_scalar(const model::Model& model, const plan::Plan& plan, Diagnostics& diagnostics) {
    const auto finite = [](const std::vector<double>& numbers) { return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }); };
    std::vector<double> numbers = {plan.rate, plan.condition_limit, plan.deviation_limit};
    for (const plan::NoiseChannel& c : plan.noise) numbers.push_back(c.factor);
    numbers.insert(numbers.end(), plan.noise_floor.begin(), plan.noise_floor.end());
    if (plan.moments) {
        for (const plan::MomentTable& t : plan.moments->tables) {
            numbers.insert(numbers.end(), t.coefficients.begin(), t.coefficients.end());
            numbers.insert(numbers.end(), t.growing.begin(), t.growing.end());
            numbers.insert(numbers.end(), {t.oldest, t.newest, t.of_one, t.gain});
        }
    }
    for (const plan::Row& row : plan.perturbation) for (const plan::RowTerm& term : row.terms) numbers.push_back(term.factor);
    for (const plan::Row& row : plan.rows) for (const plan::RowTerm& term : row.terms) numbers.push_back(term.factor);
    for (const plan::Parameter& p : plan.parameters) numbers.push_back(p.initial);
    const auto elimination = plan::make_elimination<double>(plan.elimination);
    for (const auto* of : {&elimination.sizes, &elimination.coefficient_of, &elimination.terms}) numbers.insert(numbers.end(), of->begin(), of->end());
    for (const auto& a : elimination.alone) numbers.push_back(a.coefficient);
    for (const plan::Tape* tape : {&plan.signals, &plan.parameter_map, &plan.map_derivatives}) for (const plan::Operation& o : tape->operations) numbers.push_back(o.value);
    const bool tables_fit = std::all_of(plan.tables.begin(), plan.tables.end(), [&](const plan::Table& t) { return finite(t.weights); });
    if (tables_fit && finite(numbers)) return true;
    diagnostics.error(model.path, model.sampling_at, std::string("a number of the estimator is beyond the range of ") + (plan.scalar == plan::Scalar::float64 ? "double" : "float"),
                       "measure in units of the signals' own size, e.g. ms and mm, or use double");
    return false;
}

/// The runtime counts in 16 bits, and sizes in 31.
bool fits_the_runtime(const model::Model& model, const plan::Plan& plan, Diagnostics& diagnostics) {
    std::size_t terms = 0;
    for (const plan::Row& row : plan.rows) terms += row.terms.size();
    for (const plan::Row& row : plan.perturbation) terms += row.terms.size();
    const std::size_t rings = static_cast<std::size_t>(plan.rings());
    const std::size_t most = std::max({plan.tables.size(), rings, plan.rows.size(), plan.lumped.size(), plan.noise.size(), terms});
    const double unknowns = static_cast<double>(plan.lumped.size());
    const double waiting = (plan.longest_wait() + 1.0) * static_cast<double>(plan.inputs.size());
    const double scalars = waiting + std::max(2.0 * static_cast<double>(rings) * (plan.samples() + plan.kept),
                                    std::max((plan.solve_instants + 5.0) * (unknowns + 1) * (unknowns + 2) / 2, static_cast<double>(plan.tables.size()) * plan.samples()));
    if (most < 65535 && scalars < 2e8) return true;
    diagnostics.error(model.path, model.sampling_at, "the estimator is too large: " + std::to_string(terms) + " terms, arrays of up to " + std::to_string(static_cast<long>(scalars)) + " numbers",
                       "use a shorter window, fewer rows, or fewer equations in one model");
    return false;
}

}  // namespace

bool within_limits(const model::Model& model, const plan::Plan& plan, Diagnostics& diagnostics) {
    return fits_the_runtime(model, plan, diagnostics) && numbers_fit_the_scalar(model, plan, diagnostics);
}

}  // namespace algest::generator
