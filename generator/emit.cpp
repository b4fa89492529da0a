// SPDX-License-Identifier: GPL-3.0-or-later
// Plan -> the files that a user compiles: data for the templates under templates/cpp.
#include <algorithm>
#include <cmath>

#include "generator/blueprint.hpp"
#include "generator/cost.hpp"
#include "generator/cpp_text.hpp"
#include "generator/elimination_text.hpp"
#include "generator/exact.hpp"
#include "generator/generate.hpp"
#include "generator/plan_hash.hpp"
#include "generator/render.hpp"

#ifndef ALGEST_VERSION
#define ALGEST_VERSION "0"
#endif

namespace algest::generator {

namespace {

using plan::Op;
using plan::Plan;

std::string accumulator_name(const Plan& plan) {
    return plan.moments->accumulators == plan::Accumulators::float64 ? "double" : "Twofold<" + scalar_name(plan.scalar) + ">";
}

std::string solve_name(const Plan& plan) {
    switch (plan.solve) {
        case Solve::square: return "square";
        case Solve::robust: return "robust";
        case Solve::least_squares: return "least_squares";
        case Solve::elimination: return "elimination";
    }
    return "?";
}

std::string quadrature_name(const Plan& plan) {
    switch (plan.quadrature) {
        case plan::Quadrature::exact: return "exact";
        case plan::Quadrature::trapezoid: return "trapezoid";
        case plan::Quadrature::simpson: return "simpson";
    }
    return "?";
}

/// True where an operation's time is libm's to say.
bool uses_libm(const plan::Tape& tape) {
    return std::any_of(tape.operations.begin(), tape.operations.end(), [](const plan::Operation& o) {
        return o.op == Op::exp || o.op == Op::log || o.op == Op::sin || o.op == Op::cos || o.op == Op::tan || o.op == Op::pow;
    });
}

/// A tape as C++: one constant per operation that computes something, inputs by their names.
class PrintedTape {
public:
    /// `input(op, k)`: C++ text of an operation that reads; `prefix`: of the constants' names.
    template <class Input>
    PrintedTape(const plan::Tape& tape, const Plan& plan, std::string prefix, Input input) : prefix_(std::move(prefix)) {
        for (std::size_t k = 0; k < tape.operations.size(); ++k) {
            const plan::Operation& o = tape.operations[k];
            const bool reads = o.op == Op::input || o.op == Op::previous || o.op == Op::derivative;
            if (reads) {
                texts_.push_back(input(o.op, o.a));
                continue;
            }
            if (o.op == Op::constant) {
                const bool whole = std::floor(o.value) == o.value && std::abs(o.value) < 1e6;
                texts_.push_back(whole ? "Scalar(" + std::to_string(static_cast<long>(o.value)) + ")" : literal(o.value, plan.scalar));
                continue;
            }
            Data line;
            line.set("number", std::to_string(k));
            line.set("expression", expression(o));
            lines_.push_back(line);
            texts_.push_back(prefix_ + std::to_string(k));
        }
        for (const int r : tape.results) results_.push_back(texts_[static_cast<std::size_t>(r)]);
    }

    Data lines() const { return listed(lines_); }
    const std::vector<std::string>& results() const { return results_; }
private:
    std::string expression(const plan::Operation& o) const {
        const std::string a = o.a < 0 ? "" : texts_[static_cast<std::size_t>(o.a)];
        const std::string b = o.b < 0 ? "" : texts_[static_cast<std::size_t>(o.b)];
        switch (o.op) {
            case Op::neg: return "-" + a;
            case Op::add: return a + " + " + b;
            case Op::sub: return a + " - " + b;
            case Op::mul: return a + " * " + b;
            case Op::div: return a + " / " + b;
            case Op::sqrt: return "std::sqrt(" + a + ")";
            case Op::exp: return "std::exp(" + a + ")";
            case Op::log: return "std::log(" + a + ")";
            case Op::sin: return "std::sin(" + a + ")";
            case Op::cos: return "std::cos(" + a + ")";
            case Op::tan: return "std::tan(" + a + ")";
            case Op::abs: return "std::abs(" + a + ")";
            case Op::sgn: return "sgn(" + a + ")";
            case Op::min: return "smaller(" + a + ", " + b + ")";
            case Op::max: return "larger(" + a + ", " + b + ")";
            case Op::pow: return "std::pow(" + a + ", " + b + ")";
            case Op::constant:
            case Op::input:
            case Op::previous:
            case Op::derivative: break;
        }
        return "?";
    }

    std::string prefix_;
    std::vector<std::string> texts_;
    std::vector<std::string> results_;
    DataList lines_;
};

Data head(const Plan& plan, const std::string& hash) {
    Data d;
    d.set("version", std::string(ALGEST_VERSION));
    d.set("name", plan.name);
    d.set("class_name", plan.class_name);
    d.set("summary", plan.summary);
    d.set("has_summary", !plan.summary.empty());
    d.set("source", plan.source);
    d.set("has_source", !plan.source.empty());
    d.set("scalar", scalar_name(plan.scalar));
    d.set("engine", std::string(plan.moments ? "moments" : "fir"));
    d.set("moments", plan.moments.has_value());
    d.set("windows", plan.name + (plan.moments ? "_tables::moment_blueprint, memory(), moments()" : "_tables::blueprint, memory()"));
    d.set("accumulators", plan.moments ? std::string(accumulator_name(plan)) : "");
    d.set("twofold", plan.moments && plan.moments->accumulators == plan::Accumulators::twofold);
    d.set("growing", plan.moments && plan.moments->shortest > 0);
    d.set("degree", plan.moments ? std::to_string(plan.moments->degree) : "");
    d.set("solve", solve_name(plan));
    d.set("quadrature", quadrature_name(plan));
    d.set("hash", hash);
    d.set("abi", std::to_string(ALGEST_RUNTIME_ABI));
    d.set("samples", std::to_string(plan.samples()));
    d.set("signals", std::to_string(plan.rings()));
    d.set("window_signals", std::to_string(plan.window_signals.size()));
    d.set("kept", std::to_string(plan.kept));
    d.set("perturbation_rows", std::to_string(plan.perturbation.size()));
    d.set("lumped_count", std::to_string(std::max(plan.lumped.size() + plan.perturbation.size(), plan.parameters.size())));
    set_elimination(plan, d);
    d.set("most_rows", std::to_string(std::max(plan.rows.size(), plan.perturbation.size())));
    d.set("decimate", std::to_string(plan.decimate));
    d.set("decimated", plan.decimate > 1);
    d.set("uncertain", plan.uncertain());
    d.set("noisy", !plan.noise.empty());
    d.set("above_noise", plan.margin_over_noise > 0.0);
    d.set("points_above_noise", plan.points_above_noise());
    d.set("rows_above_noise", plan.margin_over_noise > 0.0 && plan.normalise);
    d.set("whitened", plan.whiten);
    d.set("ratio", plan.ratio.has_value());
    d.set("limited_deviation", plan.deviation_limit > 0.0);
    d.set("has_noise_floor", !plan.noise_floor.empty() && !plan.normalise);
    d.set("deviation_limit_text", exact::decimal(exact::from_double(plan.deviation_limit)));
    d.set("has_perturbation", !plan.perturbation.empty());
    d.set("discrete", plan.discrete.has_value());
    d.set("normalise", plan.normalise);
    d.set("rows", std::to_string(plan.rows.size()));
    d.set("unknowns", std::to_string(plan.lumped.size()));
    d.set("instants", std::to_string(plan.solve_instants));
    d.set("period", exact::decimal(exact::from_text(plan.period_text)));
    return d;
}

void set_cost(const Plan& plan, Data& d) {
    const Cost cost = cost_of(plan);
    const bool square = plan.solve == Solve::square;
    d.set("push_macs", std::to_string(cost.push));
    d.set("estimate_macs", std::to_string(cost.estimate));
    const int rows = static_cast<int>(plan.rows.size());
    const int unknowns = static_cast<int>(plan.lumped.size());
    if (plan.uncertain()) {
        d.set("uncertainty_macs", std::to_string(cost.uncertainty));
        const int scratch = plan.points_above_noise() ? point_uncertainty_scratch(plan::make_blueprint<double>(plan).view()) : uncertainty_scratch(rows, unknowns, plan.solve_instants);
        d.set("uncertainty_stack", std::to_string((scratch + static_cast<int>(plan.map_derivatives.results.size())) * scalar_bytes(plan.scalar)));
        d.set("whiten_macs", std::to_string(cost.whitening));
    }
    d.set("spare", std::to_string(spare_samples));
    d.set("overtaken", std::to_string(square && !plan.moments ? spare_samples : published_slots - 1));
    d.set("size", std::to_string(cost.instance_bytes));
    d.set("table_bytes", std::to_string(cost.table_bytes));
    const int first_ok = plan.samples_to_first_estimate();
    d.set("first_ok", std::to_string(first_ok));
    d.set("first_ok_s", exact::decimal(exact::from_text(plan.period_text) * (first_ok - 1)));
}

/// Operating points: what is averaged, and how steady it has to be.
void set_steady(const Plan& plan, Data& d) {
    d.set("steady", plan.steady.has_value());
    if (!plan.steady) return;
    const plan::SteadyState& steady = *plan.steady;
    const PrintedTape tape(steady.quantities, plan, "q", [&](Op, int k) { return "s." + plan.inputs[static_cast<std::size_t>(k)].name; });
    DataList quantities;
    for (std::size_t k = 0; k < steady.averaged.size(); ++k) {
        const plan::Averaged& a = steady.averaged[k];
        Data q;
        q.set("value", tape.results()[k]);
        q.set("tolerance", std::isfinite(a.tolerance) ? literal(a.tolerance, plan.scalar) : std::string("std::numeric_limits<Scalar>::infinity()"));
        q.set("what", a.name + " " + unit_text(a.unit));
        quantities.push_back(q);
    }
    d.set("quantity_lines", tape.lines());
    d.set("quantities", listed(quantities));
    d.set("quantity_count", std::to_string(quantities.size()));
    d.set("block", std::to_string(steady.block));
    d.set("stretch", steady.stretches < 0 ? std::string("Scalar(1)") : "s." + plan.inputs[static_cast<std::size_t>(steady.stretches)].name);
    d.set("has_stretches", steady.stretches >= 0);
    d.set("stretch_name", steady.stretches < 0 ? std::string() : plan.inputs[static_cast<std::size_t>(steady.stretches)].name);
}

/// Delay lines: one an input of which some past is read, all of one length.
void set_past(const Plan& plan, Data& d) {
    const std::vector<int> lines = plan.delayed_inputs();
    DataList names;
    for (const int i : lines) {
        Data line;
        line.set("name", plan.inputs[static_cast<std::size_t>(i)].name);
        names.push_back(line);
    }
    DataList past;
    for (const plan::PastInput& p : plan.past) {
        const auto line = std::find(lines.begin(), lines.end(), p.input) - lines.begin();
        Data one;
        one.set("number", std::to_string(past.size()));
        one.set("offset", std::to_string(line * plan.delay_length()));
        one.set("ago", std::to_string(p.samples));
        one.set("name", plan.inputs[static_cast<std::size_t>(p.input)].name);
        past.push_back(one);
    }
    d.set("has_past", !plan.past.empty());
    d.set("delay_length", std::to_string(plan.delay_length()));
    d.set("delay_lines", std::to_string(lines.size()));
    d.set("lines", listed(names));
    d.set("past", listed(past));
}

std::string estimator_header(const Plan& plan, const std::string& hash) {
    Data d = head(plan, hash);
    set_cost(plan, d);
    d.set("delayed", plan.delayed());
    d.set("aligned", plan.longest_wait() > 0);
    d.set("longest_wait", std::to_string(plan.longest_wait()));
    d.set("differentiates", plan.functional == plan::Functional::derivative);
    d.set("late", plan.delayed() && plan.functional == plan::Functional::annihilator);
    DataList inputs;
    DataList filters;
    for (const plan::Input& input : plan.inputs) {
        Data i = input_data(input, plan.scalar);
        i.set("waits", input.wait > 0);
        i.set("wait", std::to_string(input.wait));
        inputs.push_back(i);
        if (input.differentiated) {
            i.set("rate", literal(plan.rate, plan.scalar));
            filters.push_back(i);
        }
    }
    d.set("inputs", listed(inputs));
    d.set("filters", listed(filters));

    set_steady(plan, d);
    const PrintedTape signals(plan.signals, plan, "v", [&](Op op, int k) {
        if (plan.steady) return "means[" + std::to_string(k) + "]";
        if (k >= static_cast<int>(plan.inputs.size())) return "past" + std::to_string(k - static_cast<int>(plan.inputs.size()));
        const std::string& name = plan.inputs[static_cast<std::size_t>(k)].name;
        return op == Op::input ? "s." + name : op == Op::previous ? "previous_." + name : "derivative_" + name;
    });
    d.set("signal_lines", signals.lines());
    set_past(plan, d);
    DataList windows;
    for (std::size_t k = 0; k < static_cast<std::size_t>(plan.rings()); ++k) {
        const bool signal = k < plan.window_signals.size();
        Data w;
        w.set("value", signals.results()[k]);
        w.set("text", signal ? plan.window_signals[k].text : plan.partials[k - plan.window_signals.size()]);
        w.set("delayed_signal", signal && plan.window_signals[k].delayed);
        windows.push_back(w);
    }
    d.set("signals_list", listed(windows));

    const PrintedTape map(plan.parameter_map, plan, "m", [](Op, int k) { return "lumped[" + std::to_string(k) + "]"; });
    d.set("map_lines", map.lines());
    d.set("libm", uses_libm(plan.signals) || uses_libm(plan.parameter_map) || (plan.steady && uses_libm(plan.steady->quantities)));
    DataList parameters;
    DataList estimated;
    std::string names;
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
        const plan::Parameter& p = plan.parameters[k];
        Data i;
        i.set("name", p.name);
        i.set("unit", unit_text(p.unit) + (p.from == p.name ? "" : (p.perturbation ? ": " : " = ") + p.from));
        i.set("unit_alone", unit_text(p.unit));
        i.set("initial", literal(p.initial, plan.scalar));
        i.set("value", map.results()[k]);
        parameters.push_back(i);
        if (p.perturbation) continue;
        estimated.push_back(i);
        names += (names.empty() ? "" : ", ") + p.name;
    }
    d.set("estimated", listed(estimated));
    DataList held;
    for (int k = 0; k < plan.rings(); ++k) {
        Data i;
        i.set("flag", std::string(k < static_cast<int>(plan.window_signals.size()) && plan.window_signals[static_cast<std::size_t>(k)].held ? "1" : "0"));
        held.push_back(i);
    }
    d.set("held_list", listed(held));
    d.set("solved_count", plan.elimination ? std::to_string(plan.parameters.size()) : std::string("unknowns"));
    if (plan.uncertain() && !plan.elimination) {
        const PrintedTape derivatives(plan.map_derivatives, plan, "d", [](Op, int k) { return "lumped[" + std::to_string(k) + "]"; });
        d.set("derivative_lines", derivatives.lines());
        const std::size_t gradients = static_cast<std::size_t>(plan.estimated()) * plan.lumped.size();
        DataList gradient;
        DataList curvature;
        for (std::size_t k = 0; k < derivatives.results().size(); ++k) {
            Data i;
            i.set("value", derivatives.results()[k]);
            (k < gradients ? gradient : curvature).push_back(i);
        }
        d.set("gradient", listed(gradient));
        d.set("curvature", listed(curvature));
        d.set("gradient_count", std::to_string(gradient.size()));
        d.set("curvature_count", std::to_string(curvature.size()));
    }
    d.set("parameters", listed(parameters));
    d.set("parameter_count", std::to_string(plan.parameters.size()));
    d.set("parameter_list", names);
    return render("cpp/estimator.hpp.mustache", d);
}

/// Stands in the rendered text where the weights of the next table belong: megabytes, which mustache would copy five times.
constexpr char place_of_weights = '\x01';

/// The weights of a table, four a line.
void append_weights(const plan::Table& table, const Plan& plan, std::string& out) {
    const char* const end = plan.scalar == plan::Scalar::float32 ? "f," : ",";
    for (std::size_t k = 0; k < table.weights.size(); ++k) {
        out += k % 4 == 0 ? (k == 0 ? "    " : "\n    ") : " ";
        exact::append_hexadecimal(table.weights[k], out);
        out += end;
    }
}

std::string with_weights(const std::string& rendered, const Plan& plan) {
    constexpr std::size_t longest_weight = 27;   // " -0x1.0123456789abcp-1074f,"
    std::string out;
    out.reserve(rendered.size() + longest_weight * plan.tables.size() * static_cast<std::size_t>(plan.samples()));
    std::size_t table = 0;
    for (const char c : rendered) {
        if (c == place_of_weights) append_weights(plan.tables.at(table++), plan, out);
        else out += c;
    }
    return out;
}

/// The functionals and terms of rows, under names with a prefix.
void set_rows(const Plan& plan, const plan::RowData<double>& rows, const std::string& prefix, Data& d) {
    DataList functionals;
    for (const Functional& f : rows.functionals) {
        Data i;
        const bool constant = f.table == no_table;
        i.set("table", constant ? std::string("no_table") : std::to_string(f.table));
        i.set("signal", std::to_string(f.signal));
        i.set("first", std::to_string(f.first_term));
        i.set("count", std::to_string(f.terms));
        i.set("text", constant ? std::string("of the constant 1") : plan.tables[f.table].name + " of " + plan.window_signals[f.signal].text);
        functionals.push_back(i);
    }
    d.set(prefix + "functionals", listed(functionals));
    d.set(prefix + "functional_count", std::to_string(rows.functionals.size()));
    DataList terms;
    for (const Term<double>& term : rows.terms) {
        Data i;
        i.set("row", std::to_string(term.row));
        i.set("column", std::to_string(term.column));
        i.set("factor", literal(term.factor, plan.scalar));
        terms.push_back(i);
    }
    d.set(prefix + "terms", listed(terms));
    d.set(prefix + "term_count", std::to_string(rows.terms.size()));
}

std::string joined(const std::vector<std::uint16_t>& numbers) {
    std::string out;
    for (const std::uint16_t n : numbers) out += (out.empty() ? "" : ", ") + std::to_string(n);
    return out;
}

std::string joined(const std::vector<double>& numbers, const Plan& plan) {
    std::string out;
    for (const double x : numbers) out += (out.empty() ? "" : ", ") + literal(x, plan.scalar);
    return out;
}

/// A line a row, as many numbers each.
std::string by_row(const std::vector<double>& numbers, const Plan& plan) {
    std::string out;
    const auto row = static_cast<std::ptrdiff_t>(numbers.size() / plan.rows.size());
    for (auto at = numbers.begin(); at != numbers.end(); at += row) out += "\n    " + joined({at, at + row}, plan) + ",";
    return out + "\n";
}

/// Literals of type double, whatever the plan's scalar.
std::string doubles(const std::vector<double>& numbers) {
    std::string out;
    for (const double x : numbers) out += (out.empty() ? "" : ", ") + exact::hexadecimal(x);
    return out;
}

/// Literals of Twofold, or of double where there are no rests.
std::string accumulators(const plan::MomentTable& table, const Plan& plan) {
    if (table.rests.empty()) return doubles(table.coefficients);
    std::string out;
    for (std::size_t k = 0; k < table.rests.size(); ++k) out += (k == 0 ? "{" : ", {") + literal(table.coefficients[k], plan.scalar) + ", " + literal(table.rests[k], plan.scalar) + "}";
    return out;
}

/// The numbers of windowed moments, by table.
void set_moments(const Plan& plan, Data& d) {
    DataList list;
    for (std::size_t t = 0; t < plan.tables.size(); ++t) {
        const plan::MomentTable& table = plan.moments->tables[t];
        Data i;
        i.set("table_name", plan.tables[t].name);
        i.set("coefficients", accumulators(table, plan));
        i.set("growing", doubles(table.growing));
        i.set("growing_newest", doubles(table.growing_newest));
        i.set("derivative", std::to_string(table.derivative));
        i.set("ends", joined({table.oldest, table.newest, table.of_one, table.gain}, plan) + ", " + std::to_string(table.degree));
        list.push_back(i);
    }
    d.set("moment_tables", listed(list));
    d.set("table_count", std::to_string(plan.tables.size()));
    d.set("coefficient_count", std::to_string(plan.tables.size() * static_cast<std::size_t>(plan.moments->degree + 1)));
    std::string degrees;
    for (const int degree : plan.moments->degrees) degrees += (degrees.empty() ? "" : ", ") + std::to_string(degree);
    d.set("degrees", degrees);
    const std::size_t count = static_cast<std::size_t>(plan.moments->degree) + 1;
    d.set("growing_count", std::to_string(plan.tables.size() * count * count));
    d.set("shortest", std::to_string(plan.moments->shortest));
    d.set("step", literal(plan.moments->step, plan.scalar));
}

std::string tables_header(const Plan& plan, const std::string& hash) {
    Data d = head(plan, hash);
    if (plan.moments) set_moments(plan, d);
    DataList tables;
    for (const plan::Table& table : plan.tables) {
        std::string kernel;
        for (const std::string& c : table.kernel) kernel += (kernel.empty() ? "" : " ") + c;
        Data t;
        t.set("table_name", table.name);
        t.set("kernel", kernel);
        t.set("values", std::string(1, place_of_weights));
        tables.push_back(t);
    }
    d.set("tables", listed(tables));
    const std::string weights = std::to_string(plan.tables.size() * static_cast<std::size_t>(plan.samples()));
    d.set("weight_count", weights);
    d.set("weights_view", plan.moments ? "{nullptr, 0}" : "{weights, " + weights + "}");

    const auto blueprint = plan::make_blueprint<double>(plan);
    set_rows(plan, blueprint.rows, "", d);
    set_rows(plan, blueprint.perturbation, "perturbation_", d);
    DataList channels;
    for (const NoiseChannel<double>& c : blueprint.noise) {
        Data i;
        i.set("input", std::to_string(c.input));
        i.set("signal", std::to_string(c.signal));
        i.set("partial", c.partial == no_partial ? std::string("no_partial") : std::to_string(c.partial));
        i.set("lag", std::to_string(c.lag));
        i.set("factor", literal(c.factor, plan.scalar));
        i.set("text", plan.tape_input(blueprint.noisy[c.input]) + " in " + plan.window_signals[c.signal].text);
        channels.push_back(i);
    }
    d.set("noise", listed(channels));
    d.set("noise_count", std::to_string(blueprint.noise.size()));
    d.set("noisy_inputs", std::to_string(blueprint.noisy.size()));
    d.set("whiten_at", joined(blueprint.whiten_at, plan));
    d.set("has_noise_tests", !blueprint.sizes.empty() || !blueprint.noise_floor.empty() || plan.margin_over_noise > 0.0);
    d.set("margin_over_noise", literal(plan.margin_over_noise, plan.scalar));
    d.set("has_sizes", !blueprint.sizes.empty());
    d.set("sizes_count", std::to_string(blueprint.sizes.size()));
    d.set("first_columns", joined(blueprint.points.first));
    d.set("first_columns_count", std::to_string(blueprint.points.first.size()));
    d.set("point_columns", joined(blueprint.points.columns));
    d.set("point_columns_count", std::to_string(blueprint.points.columns.size()));
    d.set("point_groups", joined(blueprint.points.group));
    d.set("groups", std::to_string(blueprint.points.groups));
    d.set("sizes", joined(blueprint.sizes, plan));
    d.set("noise_of_rows", plan.normalise && !blueprint.noise_floor.empty());
    d.set("has_floor_numbers", !blueprint.noise_floor.empty());
    d.set("output", std::to_string(plan.output));
    d.set("output_noise", literal(plan.output_noise, plan.scalar));
    d.set("noise_floor", plan.normalise ? by_row(blueprint.noise_floor, plan) : joined(blueprint.noise_floor, plan));
    d.set("noise_floor_count", std::to_string(blueprint.noise_floor.size()));
    d.set("keep", literal(plan.keep, plan.scalar));
    d.set("condition_limit", literal(plan.condition_limit, plan.scalar));
    d.set("deviation_limit", literal(plan.deviation_limit, plan.scalar));
    d.set("ratio_numbers", plan.ratio ? "{true, {" + joined(plan.ratio->transition, plan) + "}, {" + joined(plan.ratio->before, plan) + "}, {" + joined(plan.ratio->now, plan) + "}}"
                                      : std::string("{false, {}, {}, {}}"));
    return with_weights(render("cpp/tables.hpp.mustache", d), plan);
}

}  // namespace

std::vector<EmittedFile> emit(const Plan& plan) {
    const std::string stem = plan.name + "/" + plan.name;
    const std::string hash = plan_hash(plan);
    std::vector<EmittedFile> out;
    out.push_back({stem + ".hpp", estimator_header(plan, hash)});
    out.push_back({stem + "_tables.hpp", tables_header(plan, hash)});
    out.push_back({stem + ".md", derivation_text(plan)});
    return out;
}

}  // namespace algest::generator
