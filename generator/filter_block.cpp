// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/filter_block.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "generator/cpp_text.hpp"
#include "generator/names.hpp"
#include "generator/parabola.hpp"
#include "generator/units.hpp"

#ifndef ALGEST_VERSION
#define ALGEST_VERSION "0"
#endif

namespace algest::generator {

namespace {

using exact::Rational;

Data common(const FilterBlock& block) {
    Data d;
    d.set("version", std::string(ALGEST_VERSION));
    d.set("name", block.name);
    d.set("class_name", block.class_name);
    d.set("summary", block.summary);
    d.set("has_summary", !block.summary.empty());
    d.set("source", block.source);
    d.set("has_source", !block.source.empty());
    d.set("period", exact::decimal(block.period));
    return d;
}

/// Scalars and bytes of one instance, as the class lays them out (parabola_filter.hpp.mustache).
int instance_bytes(const FilterBlock& block) {
    const int signals = static_cast<int>(block.inputs.size());
    const int scalars = 3 * signals + 1 + 2 * signals;   // sample before, value and slope; Output: status padded to a scalar, two a signal
    return scalars * scalar_bytes(block.scalar) + 8;
}

std::string header(const FilterBlock& block) {
    Data d = common(block);
    d.set("scalar", scalar_name(block.scalar));
    d.set("abi", std::to_string(ALGEST_RUNTIME_ABI));
    d.set("size", std::to_string(instance_bytes(block)));
    d.set("rate", literal(exact::nearest(1 / block.period, block.scalar), block.scalar));
    DataList inputs;
    for (const FilteredInput& f : block.inputs) {
        Data i = input_data(f.input, block.scalar);
        i.set("derivative_unit", unit_text(f.derivative_unit));
        inputs.push_back(i);
    }
    d.set("inputs", listed(inputs));
    return render("cpp/parabola_filter.hpp.mustache", d);
}

double gain_of_noise(parabola::Output output) { return std::sqrt(exact::nearest(parabola::noise_power(output), plan::Scalar::float64)); }

/// Value and derivative against what a constant, and i 2 pi f, would be.
Data response(int percent) {
    const double f = percent / 100.0;
    const auto value = parabola::frequency_response(parabola::Output::value, f);
    const auto slope = parabola::frequency_response(parabola::Output::slope, f) / std::complex<double>(0.0, 2.0 * std::numbers::pi * f);
    const auto degrees = [](std::complex<double> z) { return std::arg(z) * 180.0 / std::numbers::pi; };
    Data d;
    d.set("f", fmt::format("{:.2f}", f));
    d.set("value", fmt::format("{:.3f}", std::abs(value)));
    d.set("value_phase", fmt::format("{:.1f}", std::abs(value) > 1e-9 ? degrees(value) : 0.0));
    d.set("slope", fmt::format("{:.3f}", std::abs(slope)));
    d.set("slope_phase", fmt::format("{:.1f}", degrees(slope)));
    return d;
}

}  // namespace

FilterBlock filter_block(const model::Model& model, plan::Scalar scalar) {
    FilterBlock out{model.name, model::class_name(model.name), model.summary, model.source, scalar, *model.period, {}};
    const double infinity = std::numeric_limits<double>::infinity();
    for (const int s : model.filter->signals) {
        const model::Signal& signal = model.signals[static_cast<std::size_t>(s)];
        const std::string per_second = signal.unit.empty() ? "" : units::Unit::parse(signal.unit)->over(*units::Unit::parse("s")).text();
        out.inputs.push_back({{signal.name, signal.unit, signal.column, signal.min ? exact::nearest(*signal.min, scalar) : -infinity,
                               signal.max ? exact::nearest(*signal.max, scalar) : infinity, true},
                              per_second,
                              signal.deviation()});
    }
    return out;
}

std::string filter_derivation(const FilterBlock& block) {
    Data d = common(block);
    const auto power = [](parabola::Output output) { return exact::text(parabola::noise_power(output)); };
    d.set("value_power", power(parabola::Output::value));
    d.set("slope_power", power(parabola::Output::slope));
    d.set("value_gain", fmt::format("{:.3f}", gain_of_noise(parabola::Output::value)));
    d.set("slope_gain", fmt::format("{:.3f}", gain_of_noise(parabola::Output::slope)));
    DataList responses;
    for (const int percent : {1, 2, 5, 10, 15, 20, 30, 40, 50}) responses.push_back(response(percent));
    d.set("responses", listed(responses));
    DataList inputs;
    for (const FilteredInput& f : block.inputs) {
        if (!f.noise) continue;
        const double noise = exact::nearest(*f.noise, plan::Scalar::float64);
        const double rate = exact::nearest(1 / block.period, plan::Scalar::float64);
        Data i;
        i.set("signal", f.input.name);
        i.set("noise", fmt::format("{:.3g} {}", noise, unit_text(f.input.unit)));
        i.set("value_noise", fmt::format("{:.3g}", noise * gain_of_noise(parabola::Output::value)));
        i.set("slope_noise", fmt::format("{:.3g} {}", noise * rate * gain_of_noise(parabola::Output::slope), unit_text(f.derivative_unit)));
        inputs.push_back(i);
    }
    d.set("noisy", !inputs.empty());
    d.set("inputs", listed(inputs));
    return render("report/parabola_filter.md.mustache", d);
}

std::vector<EmittedFile> emit_filter(const FilterBlock& block) {
    const std::string stem = block.name + "/" + block.name;
    return {{stem + ".hpp", header(block)}, {stem + ".md", filter_derivation(block)}};
}

}  // namespace algest::generator
