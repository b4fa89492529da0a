// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/declared_start.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/formula.hpp"
#include "generator/tape_builder.hpp"

namespace algest::lab {

namespace {

/// What an effect puts in place of a signal everywhere, and with nothing of its own that moves: the truth behind a sensor. Empty: the sensor shows it.
std::string correction(const Variant& v, const std::string& signal) {
    for (const Amendment& a : v.amendments) {
        if (!a.states.empty()) continue;
        for (const Substitution& s : a.substitutions) if (s.what == signal && s.part == Part::everywhere) return s.by;
    }
    return "";
}

/// Of a signal that is measured and moves by an equation of its own, and of no more than it, parameters and constants: what calls a function, a derivative or a
/// delay among them, is not known at one instant.
bool is_of(const formula::Formula& f, const std::string& signal, const model::Model& model) {
    if (f->kind == formula::Kind::call) return false;
    if (f->kind == formula::Kind::name) return f->name == signal || model.parameter_index(f->name) >= 0 || model.constant(f->name) != nullptr;
    return std::all_of(f->arguments.begin(), f->arguments.end(), [&](const formula::Formula& a) { return is_of(a, signal, model); });
}

bool is_measured_start(const Variant& v, const StateEntry& entry) { return entry.order == 0 && !v.bench.measured[static_cast<std::size_t>(entry.signal)].empty(); }

/// A formula of signals and parameters, at values of them.
class Correction {
public:
    /// Nullopt where the text is none, or of more than this signal at one instant.
    static std::optional<Correction> of(const Variant& v, const std::string& signal, const std::string& text) {
        const auto parsed = formula::parse(text, [](int, const std::string&, const std::string&) {});
        if (!parsed || !is_of(*parsed, signal, v.model)) return std::nullopt;
        TapeInputs inputs;
        int next = 0;
        for (std::size_t s = 0; s < v.model.signals.size(); ++s) inputs.signal.push_back(next++);
        for (std::size_t p = 0; p < v.model.parameters.size(); ++p) inputs.parameter.push_back(next++);
        TapeBuilder builder(v.model, plan::Scalar::float64, inputs);
        builder.result(builder.formula(*parsed));
        return Correction(builder.finish(), v.model.signals.size(), v.fit.parameters);
    }

    /// Where the signal, alone of all, has this value; `moved`: that parameter by so much.
    double at(std::size_t signal, double value, std::size_t moved = 0, double by = 0) {
        inputs_[signal] = value;
        const double kept = inputs_[signals_ + moved];
        inputs_[signals_ + moved] += by;
        double out = 0;
        plan::evaluate<double>(tape_, inputs_.data(), nullptr, nullptr, values_.data(), &out);
        inputs_[signals_ + moved] = kept;
        return out;
    }

private:
    Correction(plan::Tape tape, std::size_t signals, const std::vector<double>& parameters) : tape_(std::move(tape)), inputs_(signals, 0.0), values_(tape_.operations.size()), signals_(signals) {
        inputs_.insert(inputs_.end(), parameters.begin(), parameters.end());
    }

    plan::Tape tape_;
    std::vector<double> inputs_;
    std::vector<double> values_;
    std::size_t signals_;
};

/// A value and its variance.
struct Known {
    double value;
    double variance;
};

/// Behind its sensor: what one deviation of the start and of each parameter does, all in one direction, for they hang together. Nullopt where one is not known.
std::optional<Known> behind_the_sensor(const Variant& v, std::size_t signal, const Known& shown) {
    const std::string& name = v.model.signals[signal].name;
    const std::string text = correction(v, name);
    if (text.empty()) return shown;
    auto truth = Correction::of(v, name, text);
    if (!truth) return std::nullopt;
    const double value = truth->at(signal, shown.value);
    double deviation = std::abs(truth->at(signal, shown.value + std::sqrt(shown.variance)) - value);
    for (std::size_t p = 0; p < v.fit.sd.size(); ++p) {
        const double size = std::max(std::abs(v.fit.parameters[p]), 1.0);
        if (truth->at(signal, shown.value, p, size) == value) continue;   // not in it
        if (!std::isfinite(v.fit.sd[p])) return std::nullopt;
        deviation += std::abs(truth->at(signal, shown.value, p, v.fit.sd[p]) - value);
    }
    return Known{value, deviation * deviation};
}

}  // namespace

std::map<std::string, double> away_from_declared_start(const Variant& v) {
    std::map<std::string, double> out;
    if (v.fit.begin != 0) return out;
    for (std::size_t e = 0; e < v.fit.initial_sd.size(); ++e) {
        const StateEntry& entry = v.bench.system.states[e];
        const std::size_t s = static_cast<std::size_t>(entry.signal);
        const model::Signal& signal = v.model.signals[s];
        if (!is_measured_start(v, entry) || !signal.initial || !std::isfinite(v.fit.initial_sd[e])) continue;
        const auto start = behind_the_sensor(v, s, {v.fit.initial[e], v.fit.initial_sd[e] * v.fit.initial_sd[e]});
        if (!start || !(start->variance > 0)) continue;
        const double away = start->value - exact::nearest(*signal.initial, plan::Scalar::float64);
        out[signal.name] = away * away / start->variance;
    }
    return out;
}

bool corrects_a_sensor(const Variant& v) {
    return std::any_of(v.bench.system.states.begin(), v.bench.system.states.end(), [&](const StateEntry& entry) {
        return is_measured_start(v, entry) && !correction(v, v.model.signals[static_cast<std::size_t>(entry.signal)].name).empty();
    });
}

}  // namespace algest::lab
