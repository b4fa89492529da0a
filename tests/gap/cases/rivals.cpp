// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals.hpp"

#include <algorithm>

namespace algest::gap {

namespace {

constexpr double indistinct = 0.25;  ///< what a rival may leave, in sensor noises, and still explain as well

}  // namespace

Rivals rivals(const Machine& machine, const Machine& model, const Truth& truth, const State& scale, Random& random) {
    const Fitted fitted = refit(model, truth, 3);
    if (!fitted.finite) return {};
    const System& system = *machine.system;
    std::vector<std::string> names;
    std::vector<std::function<void(Machine&)>> nudges;
    const auto add = [&](const std::optional<Effect>& rival, int index) {
        if (!rival) return;
        if (!machine.effects.empty()) {
            const Effect& hidden = machine.effects.back();
            if (rival->name == hidden.name && (rival->signal == hidden.signal && rival->inputs == hidden.inputs)) {
                if (hidden.slots.empty() || std::count(hidden.slots.begin(), hidden.slots.end(), index)) return;
            }
        }
        names.push_back(rival->name);
        nudges.emplace_back([rival](Machine& m) {
            m.effects.push_back(*rival);
            m.effects.back().values[0] *= 1e-2;
        });
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
        if (!system.quantities[q].known || model.p[q] != machine.p[q]) continue;
        names.push_back("parameter_error");
        nudges.emplace_back([q](Machine& m) { m.p[q] *= 1.001; });
    }
    const std::vector<double> left = left_with(fitted, truth, nudges);
    Rivals out;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!(left[i] < indistinct)) continue;
        out.same = out.same || left[i] < 0.02 * fitted.worst();
        if (!std::count(out.names.begin(), out.names.end(), names[i])) out.names.push_back(names[i]);
    }
    return out;
}

}  // namespace algest::gap
