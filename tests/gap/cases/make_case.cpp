// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case.hpp"
#include "rivals.hpp"
#include "rounding.hpp"
#include "strength.hpp"

namespace algest::gap {

namespace {

constexpr double resolution_share = 0.8;  ///< resolution over noise, as in the open cases

/// What the true machine, the model with true parameters, and the refitted model leave.
struct Fits {
    const Fitted &ideal, &nominal, &refitted;
};

/// The recording, as sensors with noise and resolution show it, and the errors of `fits` with that noise on top.
void measure(Case& made, const Run& run, const Truth& truth, const Fits& fits, Random& random) {
    const System& system = *made.system;
    const Machine& machine = made.machine;
    const bool coloured = made.hidden == "none_coloured", one_speed = made.hidden == "one_speed";
    const bool spoilt = std::any_of(machine.effects.begin(), machine.effects.end(), [](const Effect& e) {
        return e.signal >= 0 || (!e.inputs.empty() && e.input_texts.empty());
    });
    std::size_t output = 0;
    for (std::size_t index = 0; index < system.signals.size(); ++index) {
        const Signal& s = system.signals[index];
        std::vector<double> column, check;
        double noise = 0, resolution = 0;
        if (s.input >= 0) {
            const auto i = static_cast<std::size_t>(s.input);
            for (const auto& u : run.inputs) column.push_back(rounded(u[i], 7));
            check = column;
            for (const Effect& e : machine.effects) {
                const auto at = std::find(e.inputs.begin(), e.inputs.end(), s.input);
                if (at == e.inputs.end() || !e.input_texts.empty()) continue;
                for (std::size_t k = 0; k < column.size(); ++k) {
                    check[k] =
                        e.arrives(static_cast<std::size_t>(at - e.inputs.begin()), run.inputs, k, nullptr, e.values.data());
                }
            }
        } else {
            const std::vector<double> exact = shown(machine, run, index);
            std::vector<double> real;
            for (const State& x : run.states) real.push_back(x[static_cast<std::size_t>(s.state)]);
            // A constant speed has no size to speak of: a share of its mean then, but a small one.
            noise = rounded(
                s.noise > 0 ? s.noise : (one_speed && system.family == "dc" ? 0.2 : 1) * sensor_share * size_of(exact), 3);
            resolution = rounded(resolution_share * noise, 2);
            double colour = 0;
            for (std::size_t k = 0; k < exact.size(); ++k) {
                const double white = random.normal();
                colour = coloured ? 0.9 * colour + std::sqrt(1 - 0.81) * white : white;
                column.push_back(resolution * std::round((exact[k] + noise * colour) / resolution));
                check.push_back(real[k] + column[k] - exact[k]);
            }
            if (s.scored) {
                double square = 0;
                for (std::size_t k = 0; k < column.size(); ++k)
                    square += (column[k] - exact[k]) * (column[k] - exact[k]) / static_cast<double>(column.size());
                const double size = size_of(column), own = square / (size * size), unit = truth.sigma[output] / size;
                const auto together = [&](const Fitted& f) { return std::sqrt(own + std::pow(f.rms[output] * unit, 2)); };
                made.floor.push_back(together(fits.ideal));
                made.nominal.push_back(together(fits.nominal));
                made.refitted.push_back(together(fits.refitted));
                ++output;
            }
        }
        made.measured.push_back(column);
        if (spoilt) made.unspoilt.push_back(check);
        made.noise.push_back(noise);
        made.resolution.push_back(resolution);
    }
}

}  // namespace

Case make_case(const std::string& family, const std::string& hidden, std::uint64_t seed) {
    Random random(family + "/" + hidden, seed);
    const bool one_speed = hidden == "one_speed", nothing = hidden.rfind("none", 0) == 0,
               wrong_value = hidden.rfind("parameter_error@", 0) == 0;
    std::vector<std::string> wanted;
    if (one_speed)
        wanted = {family == "rl" ? "inverter_dead_time@0" : "coulomb_friction@1"};
    else if (!nothing && !wrong_value)
        wanted = parts(hidden, '+');
    Case made;
    made.hidden = hidden;
    made.name = family + "_" + std::to_string(seed);
    made.system =
        std::make_shared<System>(build(family, {wanted.empty() ? "" : parts(wanted[0], '@')[0], one_speed}, random));
    System& system = *made.system;
    std::vector<double> p;
    for (const Quantity& q : system.quantities) p.push_back(q.value);
    made.believed = p;

    const State scale = sizes(system, p);
    made.machine = {&system, p, {}, scale, {}};
    Machine& machine = made.machine;
    std::vector<double> targets;
    for (const std::string& w : wanted) {
        const std::string name = parts(w, '@')[0];
        const int index = std::stoi(parts(w, '@').at(1));
        auto found = effect(name, system, index, scale, random);
        if (!found) found = structural_effect(name, system, index, scale, random);
        if (!found) throw std::runtime_error(w + " does not belong into " + family);
        machine.effects.push_back(*found);
        machine.effects.back().values[0] *= found->strength_sign;
        // Weak traces of what no library holds look like something that it does hold: no engineer would blame the one who says so.
        targets.push_back(found->in_library ? visibility(random) : random.log_uniform(6, 40));
    }
    if (one_speed && family == "dc") {
        // From its steady state: friction is all that could tell, and it cannot.
        machine.effects[0].values[0] = rounded(random.uniform(0.05, 0.2) * system.slots[1].size, 2);
        std::vector<double> u(1);
        system.experiment()(0, system.initial, u);
        const double R = p[0], K = p[2], b = p[4];
        const double w = (K * u[0] / R - machine.effects[0].values[0]) / (b + K * K / R);
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
    const Truth truth = truth_of(machine);
    if (!run.finite || truth.outputs.empty()) throw std::runtime_error("diverges");
    Machine model = machine;
    model.effects.clear();
    model.process_noise.clear();
    if (wrong_value) {
        const auto q = static_cast<std::size_t>(std::stoi(parts(hidden, '@').at(1)));
        made.believed[q] = model.p[q] = misbelieve(model, truth, q, visibility(random), random);
    }
    const Fitted nominal = refit(model, truth, 0), refitted = refit(model, truth, to_the_end);
    if (!nothing && !one_speed) {
        if (std::hypot(1.0, refitted.worst()) < 1.4) throw std::runtime_error("the effect cannot be made visible");
        if (wanted.size() < 2) {
            const Effect* only = wrong_value ? nullptr : &machine.effects[0];
            const Rivals found = rivals(machine, model, only, truth, scale, random);
            made.rivals = found.names;
            const bool sensor = wrong_value || machine.effects[0].signal >= 0;
            if (sensor && found.same) {
                made.ambiguous = true;
                made.equal_terms = found.equal_terms;
                const std::string own = wrong_value ? "parameter_error" : machine.effects[0].name;
                if (!std::count(made.rivals.begin(), made.rivals.end(), own)) made.rivals.push_back(own);
                made.note = "no sensor tells a wrong constant from a wrong sensor";
            }
            if (!wrong_value && !machine.effects[0].in_library && !found.names.empty())
                throw std::runtime_error("a usual effect explains it as well");
        } else {
            // Beside the other one, each may have a rival of its own.
            for (std::size_t e = 0; e < machine.effects.size(); ++e) {
                Machine without = machine;
                without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(e));
                Random apart(family + "/" + hidden + "/rivals", seed);  // so that no rival changes the noise
                for (const std::string& name : rivals(machine, without, &machine.effects[e], truth, scale, apart).names)
                    if (!std::count(made.rivals.begin(), made.rivals.end(), name)) made.rivals.push_back(name);
            }
        }
    }
    Machine oracle = machine;
    oracle.process_noise.clear();
    const Fitted ideal = refit(oracle, truth, 0);

    measure(made, run, truth, {ideal, nominal, refitted}, random);
    for (const Quantity& q : system.quantities)
        made.initial_guess.push_back(rounded(q.value * (1 + random.sign() * random.uniform(0.05, 0.25)), 4));
    if (hidden == "none_coloured") made.note = "trap: coloured sensor noise, model is right";
    if (hidden == "none_process")
        made.note = "trap: no missing effect, but unmeasured torque noise; right: none, or unexplained without a name";
    return made;
}

}  // namespace algest::gap
