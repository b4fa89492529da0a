// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/declared_start.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/formula.hpp"
#include "generator/tape_builder.hpp"

namespace algest::lab {

namespace {

/// What effects put in place of a signal everywhere, and with nothing of their own that moves: the truth behind a sensor. Empty: the sensor shows it.
std::vector<std::string> corrections(const Variant& v, const std::string& signal) {
    std::vector<std::string> out;
    for (const Amendment& a : v.amendments) {
        if (!a.states.empty()) continue;
        const auto s = std::find_if(a.substitutions.begin(), a.substitutions.end(), [&](const Substitution& of) { return of.what == signal && of.part == Part::everywhere; });
        if (s != a.substitutions.end()) out.push_back(s->by);   // the same text in every equation
    }
    return out;
}

/// Of no more than this signal, parameters and constants: what calls a function, a derivative or a delay among them, is not known at one instant.
bool is_of(const formula::Formula& f, const std::string& signal, const model::Model& model) {
    if (f->kind == formula::Kind::call) return false;
    if (f->kind == formula::Kind::name) return f->name == signal || model.parameter_index(f->name) >= 0 || model.constant(f->name) != nullptr;
    return std::all_of(f->arguments.begin(), f->arguments.end(), [&](const formula::Formula& a) { return is_of(a, signal, model); });
}

bool is_measured_start(const Variant& v, const StateEntry& entry) { return entry.order == 0 && !v.bench.measured[static_cast<std::size_t>(entry.signal)].empty(); }

/// A formula of one signal and the fitted parameters.
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

    /// Where the signal has this value.
    double at(std::size_t signal, double value) {
        inputs_[signal] = value;
        double out = 0;
        plan::evaluate<double>(tape_, inputs_.data(), nullptr, nullptr, values_.data(), &out);
        return out;
    }

    /// The same with one parameter moved by so much.
    double with(std::size_t parameter, double by, std::size_t signal, double value) {
        double& moved = inputs_[signals_ + parameter];
        const double kept = moved;
        moved += by;
        const double out = at(signal, value);
        moved = kept;
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

/// Behind its sensor: what one deviation of the start and of each parameter does, all in one direction: they hang together, and nothing is called sure that is
/// not. Nullopt where one is not known, or several effects correct the sensor.
std::optional<Known> behind_the_sensor(const Variant& v, std::size_t signal, const Known& shown) {
    const std::string& name = v.model.signals[signal].name;
    const std::vector<std::string> texts = corrections(v, name);
    if (texts.empty()) return shown;
    if (texts.size() > 1) return std::nullopt;
    auto truth = Correction::of(v, name, texts[0]);
    if (!truth) return std::nullopt;
    const double value = truth->at(signal, shown.value);
    double deviation = std::abs(truth->at(signal, shown.value + std::sqrt(shown.variance)) - value);
    for (std::size_t p = 0; p < v.fit.sd.size(); ++p) {
        const double size = std::max(std::abs(v.fit.parameters[p]), 1.0);
        if (truth->with(p, size, signal, shown.value) == value) continue;   // not in it
        if (!std::isfinite(v.fit.sd[p])) return std::nullopt;
        deviation += std::abs(truth->with(p, v.fit.sd[p], signal, shown.value) - value);
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
        return is_measured_start(v, entry) && !corrections(v, v.model.signals[static_cast<std::size_t>(entry.signal)].name).empty();
    });
}

}  // namespace algest::lab
