// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case.hpp"
#include "rounding.hpp"

namespace algest::gap {

namespace {

const std::vector<std::string> unheld = {"bouc_wen_hysteresis", "cubic_damping", "hard_stop", "radiation"};
const double sensor_share = 0.004;     ///< sensor noise over the signal's size
const double resolution_share = 0.8;   ///< resolution over noise, as in the open cases
const double indistinct = 0.25;        ///< what a rival may leave, in sensor noises, and still explain as well

/// Effects that only a model without that term can miss.
bool needs_wish(const std::string& name) { return name == "viscous_friction" || name == "back_emf"; }

double deviation(const std::vector<double>& v) {
    double mean = 0, square = 0;
    for (const double x : v) mean += x / static_cast<double>(v.size());
    for (const double x : v) square += (x - mean) * (x - mean) / static_cast<double>(v.size());
    return std::sqrt(square);
}

/// max(std, 0.1 rms): what errors are compared with.
double size_of(const std::vector<double>& v) {
    double square = 0;
    for (const double x : v) square += x * x / static_cast<double>(v.size());
    return std::max(deviation(v), 0.1 * std::sqrt(square));
}

std::vector<std::string> parts(const std::string& text, char separator) {
    std::vector<std::string> out{""};
    for (const char c : text) {
        if (c == separator) out.emplace_back();
        else out.back() += c;
    }
    return out;
}

Truth truth_of(const Machine& machine) {
    const Run run = record(machine);
    Truth truth;
    if (!run.finite) return truth;
    truth.outputs = scored(*machine.system, run);
    truth.inputs = run.inputs;
    for (const auto& v : truth.outputs) truth.sigma.push_back(sensor_share * size_of(v));
    return truth;
}

/// Root mean square of an effect's terms over the run, against the size of their slots.
double share(const Machine& machine, const Effect& effect) {
    if (!effect.own.empty()) return 0;
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

/// Sets the strength of effects[index] so that the gap it leaves, the others known in kind, is `target` times the floor.
void tune(Machine& machine, std::size_t index, double target) {
    const double wanted = std::sqrt(target * target - 1);
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
        if (std::abs(std::log(factor)) < 0.15) break;
        strength *= std::exp(0.9 * std::log(factor));
    }
    machine.effects[index].values[0] = rounded(machine.effects[index].values[0], 3);
}

/// How visible: weak, plain or strong, as a ratio of the gap to the floor.
double visibility(Random& random) {
    const int kind = random.integer(0, 3);
    return kind == 0 ? random.log_uniform(1.6, 3) : kind == 3 ? random.log_uniform(20, 80) : random.log_uniform(3, 20);
}

/// Sizes of the states in the experiment, nothing hidden.
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

/// Unmeasured torque or force: coloured, so strong that it stands above the sensors' noise.
void shake(Machine& machine, Random& random) {
    std::size_t slot = machine.system->slots.size();
    for (std::size_t s = 0; s < machine.system->slots.size(); ++s) slot = machine.system->slots[s].kind == Kind::torque || machine.system->slots[s].kind == Kind::force ? s : slot;
    if (slot == machine.system->slots.size()) throw std::runtime_error("nothing to shake");
    const double pole = random.chance(0.5) ? 0 : 0.9;
    std::vector<double> noise;
    double v = 0;
    for (std::size_t k = 0; k < machine.system->samples(); ++k) noise.push_back(v = pole * v + std::sqrt(1 - pole * pole) * random.normal());
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

/// Effects of a usual library that explain the recording as well as the hidden one.
std::vector<std::string> rivals(const Machine& machine, const Truth& truth, const State& scale, Random& random) {
    std::vector<std::string> out;
    Machine bare = machine;
    bare.effects.pop_back();
    bare.process_noise.clear();
    const Fitted fitted = refit(bare, truth, 3);
    if (!fitted.finite) return out;
    for (int slot = 0; slot < static_cast<int>(machine.system->slots.size()); ++slot) {
        for (const std::string& name : term_effects()) {
            const Effect& hidden = machine.effects.back();
            if (name == "cogging_torque" || name == "sinusoidal_disturbance") continue;   // with their free frequency they are no line
            if (name == hidden.name && std::count(hidden.slots.begin(), hidden.slots.end(), slot)) continue;
            const auto rival = effect(name, *machine.system, slot, scale, random);
            if (rival && left_with(fitted, truth, *rival) < indistinct) {
                if (!std::count(out.begin(), out.end(), name)) out.push_back(name);
            }
        }
    }
    return out;
}

}  // namespace

std::vector<std::string> hidings(const std::string& family) {
    std::vector<std::string> out = {"none"}, singles;
    Random random(family, 0);
    const System plain = build(family, {}, random);
    bool mechanical = false;
    for (const Slot& s : plain.slots) mechanical = mechanical || s.kind == Kind::torque || s.kind == Kind::force;
    if (mechanical) out.push_back("none_process");
    out.push_back("none_coloured");
    std::vector<std::string> names = term_effects();
    names.insert(names.end(), unheld.begin(), unheld.end());
    for (const std::string& name : names) {
        Wish wish{name, false};
        const System system = build(family, wish, random);
        for (int slot = 0; slot < static_cast<int>(system.slots.size()); ++slot) {
            // Only where the wish took the term out of the model may it be hidden.
            if (needs_wish(name) && family == "mb") continue;
            if (!effect(name, system, slot, system.typical, random)) continue;
            if (needs_wish(name) && family != "dc" && family != "dca" && name == "back_emf" && family != "vc") continue;
            singles.push_back(name + "@" + std::to_string(slot));
        }
    }
    out.insert(out.end(), singles.begin(), singles.end());
    // Pairs that a bench sees: the first term effects in turn, no two of one name, none that changes the model text.
    std::vector<std::string> plainly;
    for (const std::string& s : singles) {
        const std::string name = parts(s, '@')[0];
        if (!needs_wish(name) && name != "gravity_sin" && std::count(unheld.begin(), unheld.end(), name) == 0) plainly.push_back(s);
    }
    for (std::size_t i = 0; i + 1 < plainly.size(); i += 2) {
        const std::size_t j = plainly.size() - 1 - i / 2;
        if (j != i && parts(plainly[i], '@')[0] != parts(plainly[j], '@')[0]) out.push_back(plainly[i] + "+" + plainly[j]);
    }
    if (family == "dc" || family == "rl") out.push_back("one_speed");
    return out;
}

Case make_case(const std::string& family, const std::string& hidden, std::uint64_t seed) {
    Random random(family + "/" + hidden, seed);
    const bool one_speed = hidden == "one_speed", nothing = hidden.rfind("none", 0) == 0;
    std::vector<std::string> wanted;
    if (one_speed) wanted = {family == "rl" ? "inverter_dead_time@0" : "coulomb_friction@1"};
    else if (!nothing) wanted = parts(hidden, '+');
    Case made;
    made.hidden = hidden;
    made.name = family + "_" + std::to_string(seed);
    made.system = build(family, {wanted.empty() ? "" : parts(wanted[0], '@')[0], one_speed}, random);
    System& system = made.system;
    std::vector<double> p;
    for (const Quantity& q : system.quantities) p.push_back(q.value);

    State scale = sizes(system, p);
    made.machine = {&system, p, {}, scale, {}};
    Machine& machine = made.machine;
    std::vector<double> targets;
    for (const std::string& w : wanted) {
        const auto found = effect(parts(w, '@')[0], system, std::stoi(parts(w, '@').at(1)), scale, random);
        if (!found) throw std::runtime_error(w + " does not belong into " + family);
        machine.effects.push_back(*found);
        machine.effects.back().values[0] *= found->strength_sign;
        targets.push_back(visibility(random));
    }
    if (one_speed && family == "dc") {
        // From its steady state: friction is all that could tell, and it cannot.
        machine.effects[0].values[0] = rounded(random.uniform(0.05, 0.2) * system.slots[1].size, 2);
        Effect& e = machine.effects[0];
        std::vector<double> u(1);
        system.experiment()(0, system.initial, u);
        const double R = p[0], K = p[2], b = p[4];
        const double w = (K * u[0] / R - e.values[0]) / (b + K * K / R);
        system.initial = {(u[0] - K * w) / R, w};
        system.typical = system.initial;
        machine.scale = system.initial;
        made.ambiguous = true;
        made.rivals = {"coulomb_friction", "constant_load", "quadratic_drag", "viscous_friction", "parameter_error"};
        made.note = "one constant speed: any constant braking torque fits";
    } else if (one_speed) {
        tune(machine, 0, random.log_uniform(5, 30));
        made.ambiguous = true;
        made.rivals = {"inverter_dead_time", "voltage_offset"};
        made.note = "the current never reverses: dead time or offset";
    } else {
        const int rounds = wanted.size() > 1 ? 2 : 1;
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t e = 0; e < wanted.size(); ++e) tune(machine, e, targets[e]);
        }
    }
    if (hidden == "none_process") shake(machine, random);

    const Run run = record(machine);
    Truth truth = truth_of(machine);
    if (!run.finite || truth.outputs.empty()) throw std::runtime_error("diverges");
    Machine model = machine;
    model.effects.clear();
    model.process_noise.clear();
    const Fitted nominal = refit(model, truth, 0), refitted = refit(model, truth, 3);
    if (!wanted.empty() && !one_speed && std::hypot(1.0, refitted.worst()) < 1.4) throw std::runtime_error("the effect cannot be made visible");
    if (wanted.size() == 1 && !one_speed && machine.effects[0].in_library) made.rivals = rivals(machine, truth, scale, random);
    if (wanted.size() == 1 && !one_speed && !machine.effects[0].in_library) made.rivals = rivals(machine, truth, scale, random);
    Machine oracle = machine;
    oracle.process_noise.clear();
    const Fitted ideal = refit(oracle, truth, 0);

    // The sensors.
    const bool coloured = hidden == "none_coloured";
    std::size_t output = 0;
    for (const Signal& s : system.signals) {
        std::vector<double> column;
        double noise = 0, resolution = 0;
        if (s.input >= 0) {
            for (const auto& u : run.inputs) column.push_back(rounded(u[static_cast<std::size_t>(s.input)], 7));
        } else {
            for (const State& x : run.states) column.push_back(x[static_cast<std::size_t>(s.state)]);
            const std::vector<double> exact = column;
            // A constant speed has no size to speak of: a share of its mean then, but a small one.
            noise = rounded(s.noise > 0 ? s.noise : (one_speed && family == "dc" ? 0.02 : 1) * sensor_share * size_of(column), 3);
            resolution = rounded(resolution_share * noise, 2);
            double colour = 0;
            for (double& v : column) {
                const double white = random.normal();
                colour = coloured ? 0.9 * colour + std::sqrt(1 - 0.81) * white : white;
                v = resolution * std::round((v + noise * colour) / resolution);
            }
            if (s.scored) {
                double square = 0;
                for (std::size_t k = 0; k < column.size(); ++k) square += (column[k] - exact[k]) * (column[k] - exact[k]) / static_cast<double>(column.size());
                const double size = size_of(column), own = square / (size * size), unit = truth.sigma[output] / size;
                const auto together = [&](const Fitted& f) { return std::sqrt(own + std::pow(f.rms[output] * unit, 2)); };
                made.floor.push_back(together(ideal));
                made.nominal.push_back(together(nominal));
                made.refitted.push_back(together(refitted));
                ++output;
            }
        }
        made.measured.push_back(column);
        made.noise.push_back(noise);
        made.resolution.push_back(resolution);
    }
    for (const Quantity& q : system.quantities) {
        made.initial_guess.push_back(q.known ? q.value : rounded(q.value * (1 + random.sign() * random.uniform(0.05, 0.25)), 4));
    }
    if (coloured) made.note = "trap: coloured sensor noise, model is right";
    if (hidden == "none_process") made.note = "trap: no missing effect, but unmeasured torque noise; right: none, or unexplained without a name";
    return made;
}

}  // namespace algest::gap
