// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/cost.hpp"

#include <algorithm>
#include <set>

#include "algest/boxcar.hpp"
#include "algest/delay_line.hpp"
#include "algest/dot.hpp"
#include "algest/growing_moments.hpp"
#include "algest/steady_state.hpp"
#include "algest/triangle_update.hpp"
#include "generator/blueprint.hpp"
#include "generator/cpp_text.hpp"

namespace algest::generator {

namespace {

using plan::Plan;

bool twofold(const Plan& plan) { return plan.moments->accumulators == plan::Accumulators::twofold; }
int rebuilt(const Plan& plan) { return twofold(plan) ? rebuilt_frames<Twofold<float>> : rebuilt_frames<double>; }

int references(const Plan& plan, int signals) { return twofold(plan) ? moment_references<Twofold<float>>(signals) : moment_references<double>(signals); }

int accumulators(const Plan& plan, int signals) {
    const bool growing = plan.moments->shortest > 0;
    const int degree = plan.moments->degree;
    return twofold(plan) ? moment_accumulators<Twofold<float>>(signals, degree, growing) : moment_accumulators<double>(signals, degree, growing);
}

/// Scalars and bytes of one instance, as the class lays them out (estimator.hpp.mustache).
int instance_bytes(const Plan& plan) {
    const int unknowns = static_cast<int>(plan.lumped.size());
    const int signals = plan.rings();
    const plan::PointRowData points = plan::make_point_rows(plan);
    const bool of_points = points.groups > 0;
    int scalars = of_points ? sum_scalars(points.view(), unknowns) : sum_scalars(plan.solve, unknowns, plan.solve_instants);
    if (plan.moments) {
        scalars += moment_ring(signals, plan.samples()) + 2 * references(plan, signals);
        scalars += published_row_scalars(plan.solve, static_cast<int>(plan.rows.size()), unknowns, static_cast<int>(plan.perturbation.size()));
    } else {
        scalars += ring_scalars(signals, ring_length(plan.samples(), plan.kept));
        scalars += of_points ? published_scalars(points.view(), unknowns) : published_scalars(plan.solve, unknowns);
    }
    scalars += 2 + static_cast<int>(plan.parameters.size());   // Estimate: status padded to a scalar, condition, parameters
    if (plan.whiten) scalars += unknowns;
    if (plan.ratio) scalars += ratio_scalars(true, unknowns);
    int bytes = static_cast<int>(sizeof(Progress));
    if (plan.moments) bytes += static_cast<int>(sizeof(MomentProgress)) + accumulators(plan, signals) * accumulator_bytes;
    if (plan.decimate > 1) {
        scalars += boxcar_scalars(signals);
        bytes += static_cast<int>(sizeof(BoxcarProgress));
    }
    if (plan.steady) {
        scalars += steady_scalars(static_cast<int>(plan.steady->averaged.size()));
        bytes += static_cast<int>(sizeof(SteadyProgress)) + 8;
    }
    if (plan.delayed()) {
        scalars += static_cast<int>(plan.inputs.size());
        for (const plan::Input& input : plan.inputs) scalars += input.differentiated ? 2 : 0;
        bytes += 8;
    }
    if (plan.longest_wait() > 0) {
        scalars += (plan.longest_wait() + 1) * static_cast<int>(plan.inputs.size());
        bytes += 8;
    }
    if (!plan.past.empty()) {
        scalars += static_cast<int>(plan.delayed_inputs().size()) * plan.delay_length();
        bytes += static_cast<int>(sizeof(DelayProgress));
    }
    bytes += scalars * scalar_bytes(plan.scalar);
    const int alignment = plan.moments && !twofold(plan) ? 8 : scalar_bytes(plan.scalar);
    return (bytes + alignment - 1) / alignment * alignment;
}

/// Of a table's WindowEnds.
long ends_bytes(const Plan& plan) { return static_cast<long>(plan.scalar == plan::Scalar::float32 ? sizeof(WindowEnds<float>) : sizeof(WindowEnds<double>)); }

/// Functionals that windows are needed for.
long evaluated(const plan::RowData<double>& rows) {
    long out = 0;
    for (const Functional& f : rows.functionals) out += f.table != no_table ? 1 : 0;
    return out;
}

/// Of one evaluation of rows on windows: the dot products and the sizes that rounding is measured by.
long fir_rows(const Plan& plan, const plan::RowData<double>& rows) {
    const int samples = plan.samples();
    return evaluated(rows) * (samples + (plan.scalar == plan::Scalar::float32 ? size_products<float>(samples) : size_products<double>(samples)));
}

/// What carries noise into the rows (noise_in_rows): over all noisy inputs, the products for one sample.
long noisy_products(const Plan& plan, const plan::RowData<double>& rows) {
    long out = 0;
    for (const plan::NoiseChannel& channel : plan.noise) {
        out += channel.partial >= 0 ? 1 : 0;
        for (const Functional& f : rows.functionals) out += f.table != no_table && f.signal == channel.signal ? 1 + f.terms : 0;
    }
    return out;
}

/// Inputs whose noise is declared.
long noisy_inputs(const Plan& plan) {
    std::set<int> out;
    for (const plan::NoiseChannel& channel : plan.noise) out.insert(channel.input);
    return static_cast<long>(out.size());
}

/// Raw samples that enter the windows of one instant (propagate_noise, residual_factor).
long entering_samples(const Plan& plan) {
    int lag = 1;
    for (const plan::NoiseChannel& channel : plan.noise) lag = std::max(lag, channel.lag);
    return plan.samples() + lag;
}

/// Of residual_factor, its sums: the factorisation is rows^3/6.
long whitening(const Plan& plan, const plan::RowData<double>& rows) {
    const long r = static_cast<long>(plan.rows.size());
    const long n = static_cast<long>(plan.lumped.size());
    return entering_samples(plan) * (noisy_products(plan, rows) + noisy_inputs(plan) * (r * n + r * (r + 1) / 2));
}

/// Of uncertainty(), which engine moments does not serve, on the windows of up to 32 instants: their rows, then what each noisy sample makes of each instant, and of the sum.
long uncertainty(const Plan& plan, const plan::RowData<double>& rows, long of_rows) {
    const long r = static_cast<long>(plan.rows.size());
    const long n = static_cast<long>(plan.lumped.size());
    const bool square = plan.solve == Solve::square;
    const long nodes = square ? 1 : node_count(plan.solve_instants);
    const long bias = square && r == n ? 0 : r * (3 * n + 1);
    const long whitened = plan.whiten ? r * (r + 1) / 2 * (n + 1) : 0;
    const long an_instant = entering_samples(plan) * (noisy_products(plan, rows) + noisy_inputs(plan) * (r * n * (n + 1) + bias + whitened));
    const long a_sample = n * n + n * (n + 1) / 2 + (bias > 0 ? 2 : 1) * n * n;
    return nodes * (of_rows + an_instant) + (entering_samples(plan) + std::max(plan.solve_instants - 1, 0)) * noisy_inputs(plan) * a_sample;
}

/// Of one evaluation of rows on moments: the shift, then polynomial, ends and reference of each functional (evaluate_moment_rows).
long moment_rows(const Plan& plan, const plan::RowData<double>& rows) {
    long out = 0;
    for (const long d : plan.moments->degrees) out += d * (d + 1) / 2;
    for (const Functional& f : rows.functionals) out += f.table == no_table ? 0 : plan.moments->tables[f.table].degree + 5;
    return out;
}

/// Of push() once the rows of an instant are there: into the triangle, or into S(t), where five additions an entry count like products.
long absorption(const Plan& plan) {
    const int rows = static_cast<int>(plan.rows.size());
    const int unknowns = static_cast<int>(plan.lumped.size());
    const long entries = packed_size(unknowns + 1);
    if (plan.solve == Solve::square) return 0;
    if (plan.solve == Solve::robust) return (rows + 5) * entries;
    return add_rows_cost(rows, unknowns) + (plan.keep == 1.0 ? 0 : entries);
}

/// What the margin over noise takes: at each operating point in push(), and in estimate() where that of an elimination is not counted with it.
Cost margin_cost(const Plan& plan, const plan::RowData<double>& rows) {
    Cost out{};
    if (plan.margin_over_noise == 0.0) return out;
    const long unknowns = static_cast<long>(plan.lumped.size());
    const long packed = packed_size(static_cast<int>(unknowns));
    if (plan.normalise) {
        out.estimate = rows.rows * 2 * packed + triangle_rises_above_cost(static_cast<int>(unknowns));
        return out;
    }
    const plan::PointRowData points = plan::make_point_rows(plan);
    out.push = add_point_cost(points.view(), noisy_inputs(plan), noisy_products(plan, rows), plan.keep != 1.0, static_cast<int>(unknowns)) + rows.rows;
    if (plan.solve == Solve::least_squares) out.estimate = triangle_rises_above_cost(static_cast<int>(unknowns)) + expected_residuals_cost(static_cast<int>(unknowns)) + 2;
    return out;
}

}  // namespace

Cost cost_of(const Plan& plan) {
    const plan::RowData<double> rows = plan::make_rows<double>(plan.rows, static_cast<int>(plan.lumped.size()));
    const plan::RowData<double> perturbation = plan::make_rows<double>(plan.perturbation, static_cast<int>(plan.lumped.size()));
    const bool square = plan.solve == Solve::square;
    Cost out{};
    out.instance_bytes = instance_bytes(plan);
    out.operations = plan.moments && twofold(plan) ? 10 : 2;
    const long tables = static_cast<long>(plan.tables.size());
    if (plan.moments) {
        const long d = plan.moments->degree;
        out.rows = moment_rows(plan, rows);
        long powers = d;
        for (const long degree : plan.moments->degrees) powers += degree + 1;
        out.push = (rebuilt(plan) + 2) * powers + out.rows + (plan.perturbation.empty() ? 0 : moment_rows(plan, perturbation));
        out.table_bytes = tables * ((d + 1) * accumulator_bytes + ends_bytes(plan)) + static_cast<long>(plan.moments->degrees.size());
        if (plan.moments->shortest > 0) {   // the dearest sample: in the growing window and in the frames of the sliding one
            for (const long degree : plan.moments->degrees) out.push += degree + 1;
            out.push += evaluated(rows) * (d + 2) * (d + 3);
            out.table_bytes += tables * ((d + 1) * (d + 2) * accumulator_bytes + static_cast<long>(sizeof(unsigned char)));   // and the order of the derivative
        }
    } else {
        out.rows = fir_rows(plan, rows);
        out.push = square ? 0 : out.rows;
        const Cost margin = margin_cost(plan, rows);
        out.push += margin.push;
        out.estimate = (square ? out.rows : 0) + fir_rows(plan, perturbation) + margin.estimate;
        const long of_floor = plan.normalise ? static_cast<long>(plan.noise_floor.size()) : 0;
        out.table_bytes = (tables * plan.samples() + of_floor) * scalar_bytes(plan.scalar);
    }
    out.push += absorption(plan);
    if (plan.points_above_noise()) {
        const auto elimination = plan::make_elimination<double>(plan.elimination);
        out.uncertainty = propagate_points_cost(plan::make_point_rows(plan).view(), elimination.view(), static_cast<int>(plan.lumped.size()));
    } else if (plan.uncertain()) {
        out.whitening = plan.whiten ? whitening(plan, rows) : 0;
        out.uncertainty = uncertainty(plan, rows, out.rows + out.whitening);
    }
    return out;
}

std::vector<EngineCost> engine_costs(const std::string& path, PlanOptions options) {
    options.weights = false;
    std::vector<EngineCost> out;
    for (int k = 0; k < 2; ++k) {
        Diagnostics diagnostics;   // whoever generates says the same
        const auto plan = plan_from_model(path, options, diagnostics);
        if (!plan) break;
        const std::string engine = plan->moments ? "moments" : "fir";
        if (out.empty() || out[0].engine != engine) out.push_back({engine, cost_of(*plan)});
        options.engine = plan->moments ? "fir" : "moments";
    }
    return out;
}

}  // namespace algest::generator
