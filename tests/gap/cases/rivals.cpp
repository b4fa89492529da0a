// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals.hpp"

#include <algorithm>
#include <cmath>

namespace algest::gap {

namespace {

constexpr double indistinct = 0.25;  ///< what a rival may leave, in sensor noises, and still explain as well
constexpr double promising = 0.5;    ///< of the gap: what it may leave to first order, to be fitted whole: chosen, for a fit takes time
constexpr double chi_squared = 4;    ///< two standard errors: squares of a difference that all samples of this recording together cannot show

/// One thing that might be free: an effect with its strength, or a quantity that is declared known.
struct Candidate {
    std::string name;
    std::optional<Effect> effect;
    std::size_t quantity = 0;
};

bool is_hidden(const Effect* hidden, const Effect& effect, int index) {
    if (hidden == nullptr || effect.name != hidden->name || effect.signal != hidden->signal || effect.inputs != hidden->inputs) return false;
    return hidden->slots.empty() || std::count(hidden->slots.begin(), hidden->slots.end(), index) > 0;
}

std::vector<Candidate> candidates(const Machine& machine, const Machine& model, const Effect* hidden, const State& scale, Random& random) {
    const System& system = *machine.system;
    std::vector<Candidate> out;
    const auto add = [&](const std::optional<Effect>& rival, int index) {
        if (rival && !is_hidden(hidden, *rival, index)) out.push_back({rival->name, rival});
    };
    for (int slot = 0; slot < static_cast<int>(system.slots.size()); ++slot) {
        for (const std::string& name : term_effects()) {
            if (name == "cogging_torque" || name == "sinusoidal_disturbance")
                continue;  // with their free frequency they are no line
            add(effect(name, system, slot, scale, random), slot);
        }
    }
    for (int index = 0; index < 8; ++index) {
        for (const char* name : {"input_delay", "actuator_lag", "sensor_gain", "sensor_bias"})
            add(structural_effect(name, system, index, scale, random), index);
    }
    for (std::size_t q = 0; q < system.quantities.size(); ++q) {
        if (system.quantities[q].may_be_declared_wrong() && model.p[q] == machine.p[q]) out.push_back({"parameter_error", std::nullopt, q});
    }
    return out;
}

/// The model with a little of the candidate in it.
void put(Machine& m, const Candidate& c) {
    if (c.effect) {
        m.effects.push_back(*c.effect);
        m.effects.back().values[0] *= 1e-2;
    } else {
        m.p[c.quantity] *= 1.001;
    }
}

/// Once the candidate is fitted with everything else, in sensor noises, worst output.
double left_with_all_of(const Candidate& c, const Fitted& fitted, const Truth& truth) {
    System system = *fitted.model.system;
    Machine with = fitted.model;
    with.system = &system;
    put(with, c);
    if (!c.effect) system.quantities[c.quantity].known = false;
    const Fitted out = refit(with, truth, to_the_end);
    return out.finite ? out.worst() : HUGE_VAL;  // out.model points to the system above
}

}  // namespace

Rivals rivals(const Machine& machine, const Machine& model, const Effect* hidden, const Truth& truth, const State& scale, Random& random) {
    const Fitted fitted = refit(model, truth, to_the_end);
    if (!fitted.finite) return {};
    const std::vector<Candidate> all = candidates(machine, model, hidden, scale, random);
    std::vector<std::function<void(Machine&)>> nudges;
    for (const Candidate& c : all) nudges.emplace_back([&c](Machine& m) { put(m, c); });
    std::vector<double> left = left_with(fitted, truth, nudges);
    const double samples = static_cast<double>(truth.outputs[0].size() * truth.outputs.size());
    const auto note = [](std::vector<std::string>& names, const std::string& name) {
        if (!std::count(names.begin(), names.end(), name)) names.push_back(name);
    };
    Rivals out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        // To first order it may only seem to explain it: the whole fit decides.
        if (left[i] < promising * fitted.worst()) left[i] = left_with_all_of(all[i], fitted, truth);
        const bool equal = left[i] * left[i] * samples < chi_squared;
        out.same = out.same || equal;
        if (equal && all[i].effect && !all[i].effect->slots.empty()) out.equal_terms.emplace_back(all[i].name, all[i].effect->equations(*machine.system));
        if (left[i] < indistinct) note(out.names, all[i].name);
    }
    return out;
}

}  // namespace algest::gap
