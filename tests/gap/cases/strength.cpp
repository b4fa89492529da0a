// SPDX-License-Identifier: GPL-3.0-or-later
#include "strength.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "rounding.hpp"

namespace algest::gap {

namespace {

double deviation(const std::vector<double>& v) {
    double mean = 0, square = 0;
    for (const double x : v) mean += x / static_cast<double>(v.size());
    for (const double x : v) square += (x - mean) * (x - mean) / static_cast<double>(v.size());
    return std::sqrt(square);
}

/// Root mean square of an effect's terms over the run, against the size of their slots.
double share(const Machine& machine, const Effect& effect) {
    if (!effect.own.empty() || effect.slots.empty()) return 0;
    const Run run = record(machine);
    double worst = 0;
    for (std::size_t w = 0; w < effect.slots.size(); ++w) {
        double square = 0;
        for (std::size_t k = 0; k < run.states.size(); ++k) {
            const double t = static_cast<double>(k) * machine.system->period;
            const double v = effect.term(w, run.states[k].data(), run.inputs[k].data(), t, nullptr, effect.values.data());
            square += v * v / static_cast<double>(run.states.size());
        }
        worst = std::max(worst, std::sqrt(square) / machine.system->slots[static_cast<std::size_t>(effect.slots[w])].size);
    }
    return worst;
}

}  // namespace

double size_of(const std::vector<double>& v) {
    double square = 0;
    for (const double x : v) square += x * x / static_cast<double>(v.size());
    return std::max(deviation(v), 0.1 * std::sqrt(square));
}

State sizes(const System& system, const std::vector<double>& p) {
    Machine machine{&system, p, {}, system.typical, {}};
    const Run run = record(machine);
    if (!run.finite) throw std::runtime_error("the bare machine diverges");
    State out;
    for (std::size_t i = 0; i < system.initial.size(); ++i) {
        std::vector<double> v;
        for (const State& x : run.states) v.push_back(x[i]);
        out.push_back(std::max(size_of(v), 1e-3 * system.typical[i]));
    }
    return out;
}

Truth truth_of(const Machine& machine) {
    const Run run = record(machine);
    Truth truth;
    if (!run.finite) return truth;
    truth.outputs = scored(machine, run);
    truth.inputs = run.inputs;
    for (const auto& v : truth.outputs) truth.sigma.push_back(sensor_share * size_of(v));
    return truth;
}

double visibility(Random& random) {
    const int kind = random.integer(0, 3);
    return kind == 0 ? random.log_uniform(1.6, 3) : kind == 3 ? random.log_uniform(20, 80) : random.log_uniform(3, 20);
}

void tune(Machine& machine, std::size_t index, double target) {
    const double wanted = std::sqrt(target * target - 1);
    if (!machine.effects[index].tuned) return;
    for (int i = 0; i < 9; ++i) {
        double& strength = machine.effects[index].values[0];
        const Truth truth = truth_of(machine);
        if (truth.outputs.empty()) {
            strength *= 0.3;
            continue;
        }
        Machine without = machine;
        without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(index));
        const Fitted fitted = refit(without, truth, 2);
        const double gap = fitted.finite ? fitted.worst() : 1e3;
        double factor = std::clamp(wanted / std::max(gap, 1e-9), 0.1, 10.0);
        const double now = share(machine, machine.effects[index]);
        if (now * factor > 0.5) factor = 0.5 / now;
        const double most = machine.effects[index].most;
        if (most > 0 && std::abs(strength) * factor > most) factor = most / std::abs(strength);
        if (std::abs(std::log(factor)) < 0.15) break;
        strength *= std::exp(0.9 * std::log(factor));
    }
    machine.effects[index].values[0] = rounded(machine.effects[index].values[0], 3);
}

void shake(Machine& machine, Random& random) {
    std::size_t slot = machine.system->slots.size();
    for (std::size_t s = 0; s < machine.system->slots.size(); ++s)
        slot = machine.system->slots[s].kind == Kind::torque || machine.system->slots[s].kind == Kind::force ? s : slot;
    if (slot == machine.system->slots.size()) throw std::runtime_error("nothing to shake");
    const double pole = random.chance(0.5) ? 0 : 0.9;
    std::vector<double> noise;
    double v = 0;
    for (std::size_t k = 0; k < machine.system->samples(); ++k)
        noise.push_back(v = pole * v + std::sqrt(1 - pole * pole) * random.normal());
    const double wanted = random.uniform(1, 3);
    double size = 0.02 * machine.system->slots[slot].size;
    machine.process_noise.assign(machine.system->slots.size(), {});
    for (int i = 0; i < 5; ++i) {
        machine.process_noise[slot] = noise;
        for (double& x : machine.process_noise[slot]) x *= size;
        const Truth truth = truth_of(machine);
        Machine quiet = machine;
        quiet.process_noise.clear();
        const double gap = truth.outputs.empty() ? 100 : refit(quiet, truth, 0).worst();
        if (i < 4) size *= std::clamp(wanted / gap, 0.05, 20.0);
    }
}

double misbelieve(Machine model, const Truth& truth, std::size_t q, double target, Random& random) {
    const double sign = random.sign();
    const double truth_value = model.p[q];
    double error = 0.05;
    for (int i = 0; i < 5; ++i) {
        model.p[q] = truth_value * (1 + sign * error);
        const double gap = refit(model, truth, 2).worst();
        error = std::clamp(error * std::sqrt(target * target - 1) / std::max(gap, 1e-9), 0.02, 0.15);
    }
    return rounded(truth_value * (1 + sign * error), 4);
}

}  // namespace algest::gap
