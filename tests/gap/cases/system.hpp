// SPDX-License-Identifier: GPL-3.0-or-later
// A machine: its model text, the same physics as code, the experiment that was run on it, and the places where an effect may enter.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "random.hpp"

namespace algest::gap {

using State = std::vector<double>;

/// A parameter (unknown) or constant (known) of the model. One without a unit is not checked for dimension.
struct Quantity {
    std::string name, unit;
    double value;
    bool known;
    /// Only what scales the machine: a number of poles or a gain of the controller is never wrong.
    bool may_be_declared_wrong() const { return known && name != "pp" && name != "Kp" && name != "Kd"; }
};

/// A column of the recording. `state` or `input` says which one it shows.
struct Signal {
    std::string name, unit = {};
    int state = -1;
    int input = -1;
    bool scored = true;
    double noise = 0;  ///< given only where it is not a share of the signal's size (an encoder)
};

struct Equation {
    std::string name, signal, ode;
};

/// A state, or the difference of two, under the name that the model text gives it.
struct Role {
    int state = -1, minus = -1;
    std::string text = {};
    bool given() const { return state >= 0; }
    double of(const double* x) const { return x[state] - (minus >= 0 ? x[minus] : 0.0); }
};

enum class Kind {
    torque,
    force,
    voltage,
    flow,
    heat
};

/// Where an effect may enter: one term on the right side of `equation` (and, with the other sign, of `opposite`).
struct Slot {
    Kind kind;
    int equation;
    double size;  ///< typical size of the terms of that equation: an effect much larger would be another machine
    int opposite = -1;
    Role speed = {}, angle = {}, position = {}, current = {}, level = {};
    int input = -1;
    double viscous = 0;  ///< a usual coefficient of viscous friction, where the model may be written without it
    std::set<std::string> excluded = {};  ///< effects that the model's own terms would absorb
};

/// Called once a sample, in order, with the states; sets the inputs.
using Controller = std::function<void(std::size_t sample, const State& x, std::vector<double>& u)>;

struct Feedback {
    int input;
    std::string law;
    std::function<double(const double* x, const double* u, const double* p)> value;
};

struct System {
    std::string family, summary;
    double period, duration;
    std::vector<Quantity> quantities;
    std::vector<std::string> inputs;
    State initial, typical;       ///< of the states
    std::vector<Signal> signals;  ///< in the order of the model file
    std::vector<Equation> equations;
    std::vector<Slot> slots;
    /// dx/dt; `added` holds one term for each slot, as it stands on the right side.
    std::function<void(const double* x, const double* u, const double* p, const double* added, double* rate)> rate;
    std::function<Controller()> experiment;  ///< a fresh controller for every run
    std::optional<Feedback> feedback;

    std::size_t samples() const { return static_cast<std::size_t>(duration / period + 0.5); }
};

/// What a case asks of a system before it is built.
struct Wish {
    std::string effect;      ///< viscous_friction, back_emf, gravity_sin: the model is written without that term
    bool one_speed = false;  ///< constant input, from rest in its steady state
};

std::vector<std::string> families();
System build(const std::string& family, const Wish& wish, Random& random);

}  // namespace algest::gap
