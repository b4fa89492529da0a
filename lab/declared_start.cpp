// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/declared_start.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/formula.hpp"
#include "generator/tape_builder.hpp"

namespace algest::lab {

namespace {

/// What the effects put in place of a signal everywhere, and with nothing of their own that moves: the truth behind a sensor. Empty: the sensor shows it.
std::string correction(const Variant& v, const std::string& signal) {
    for (const Amendment& a : v.amendments) {
        if (!a.states.empty()) continue;
        for (const Substitution& s : a.substitutions) if (s.what == signal && s.part == Part::everywhere) return s.by;
    }
    return "";
}

/// A formula of signals and parameters, at values of them.
class Correction {
public:
    /// Nullopt where the text is none.
    static std::optional<Correction> of(const Variant& v, const std::string& text) {
        const auto parsed = formula::parse(text, [](int, const std::string&, const std::string&) {});
        if (!parsed) return std::nullopt;
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
        inputs_[signals_ + moved] += by;
        double out = 0;
        plan::evaluate<double>(tape_, inputs_.data(), nullptr, nullptr, values_.data(), &out);
        inputs_[signals_ + moved] -= by;
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

/// Behind its sensor, by what one deviation of the start and of each parameter does, as if they were independent: nothing is called sure that is not.
Known behind_the_sensor(const Variant& v, std::size_t signal, const Known& shown) {
    const std::string text = correction(v, v.model.signals[signal].name);
    auto truth = text.empty() ? std::nullopt : Correction::of(v, text);
    if (!truth) return shown;
    const double value = truth->at(signal, shown.value);
    double variance = std::pow(truth->at(signal, shown.value + std::sqrt(shown.variance)) - value, 2);
    for (std::size_t p = 0; p < v.fit.sd.size(); ++p) {
        if (std::isfinite(v.fit.sd[p])) variance += std::pow(truth->at(signal, shown.value, p, v.fit.sd[p]) - value, 2);
    }
    return {value, variance};
}

}  // namespace

double away_from_declared_start(const Variant& v) {
    if (v.fit.begin != 0) return 0;
    double out = 0;
    for (std::size_t e = 0; e < v.fit.initial_sd.size(); ++e) {
        const StateEntry& entry = v.bench.system.states[e];
        const std::size_t s = static_cast<std::size_t>(entry.signal);
        const model::Signal& signal = v.model.signals[s];
        if (entry.order > 0 || !signal.initial || v.bench.measured[s].empty() || !std::isfinite(v.fit.initial_sd[e])) continue;
        const Known start = behind_the_sensor(v, s, {v.fit.initial[e], v.fit.initial_sd[e] * v.fit.initial_sd[e]});
        const double away = start.value - exact::nearest(*signal.initial, plan::Scalar::float64);
        if (start.variance > 0) out += away * away / start.variance;
    }
    return out;
}

bool corrects_a_sensor(const Variant& v) {
    return std::any_of(v.model.signals.begin(), v.model.signals.end(), [&](const model::Signal& s) { return !correction(v, s.name).empty(); });
}

}  // namespace algest::lab
