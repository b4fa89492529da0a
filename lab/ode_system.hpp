// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of a model as a system that can be integrated: formulas compiled once to a flat tape.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/model.hpp"
#include "generator/tape.hpp"

namespace algest::lab {

/// One scalar of the state vector: a derivative of a signal, order 0 up to one below its highest.
struct StateEntry {
    int signal;   ///< index into the model's signals
    int order;
};

/// A sgn() of one signal that moves, or of what is affine in it: it switches, or holds its argument at zero (Filippov).
struct Relay {
    int argument;   ///< result of the tape that is its argument
};

/// A sgn() of more than one signal. Several of these may hold the same state at once (the phases of an inverter): they rise from
/// -1 to 1 over a thin layer instead.
struct Layer {
    int argument;   ///< result of the tape that is its argument
    int width;      ///< input of the tape that is half its width, in the argument's unit
};

/// A delayed signal that the tapes read.
struct DelayedSignal {
    int signal;
    double by;       ///< s, where no parameter says it
    int parameter;   ///< -1: none
    bool moves;      ///< it is known at samples alone, from the run's own past: no equation of motion reads it
};

/// A derivative of a recorded input that an equation of motion holds.
struct InputDerivative {
    int signal;
    int order;
    int input;       ///< of the tapes
};

/// What jumps of such inputs do at samples (input_jumps.hpp).
struct InputJumps {
    std::vector<int> level;            ///< by moving: order of the impulse in its equation; -1: none
    std::vector<plan::Tape> factors;   ///< by moving: of its residual's derivatives by those of all moving signals, orders from 1 on, then by those of inputs
};

/// A control law that is sampled once a period and held.
struct Law {
    int signal;          ///< that it sets
    plan::Tape tape;     ///< one result; inputs as of the system
};

/// What a sensor shows, computed at the samples.
struct Output {
    int signal;
    plan::Tape tape;     ///< one result; inputs as of the system
};

/// What moves, what is replayed, and the residual  left - right  of every equation, linear in the highest derivatives.
///
/// Inputs of all tapes, in this order: signals (model order), derivatives of states above order 0 and the highest ones
/// (`derivative_input`), parameters (model order), delayed signals, derivatives of inputs, relays, widths of layers.
struct OdeSystem {
    std::vector<StateEntry> states;        ///< for each moving signal its orders 0, 1, ... in turn
    std::vector<int> moving;               ///< signals with an equation of motion of their own, in the order of those equations
    std::vector<int> gives;                ///< by equation of the model: the signal that it moves, or gives as an output
    std::vector<int> highest;              ///< by moving: order of its highest derivative
    std::vector<int> driven;               ///< signals that are replayed from the recording
    std::vector<Output> outputs;           ///< each behind those that it needs
    std::vector<Law> laws;
    std::vector<DelayedSignal> delays;
    std::vector<InputDerivative> input_derivatives;
    InputJumps input_jumps;
    std::vector<Relay> relays;
    std::vector<Layer> layers;
    std::vector<std::vector<int>> derivative_input;   ///< by moving: tape input of orders 1 .. highest
    int parameter_input = 0;               ///< tape input of the first parameter
    int delay_input = 0;                   ///< tape input of the first delayed signal, behind the last parameter
    int relay_input = 0;                   ///< tape input of the first relay
    int inputs = 0;
    plan::Tape residual;                   ///< results: one per moving signal, then the arguments of relays and layers
    bool constant_mass = true;             ///< the factors of the highest derivatives depend on parameters alone
};

/// True when a signal (index into the model's) has an equation of motion of its own.
bool moves(const OdeSystem& system, std::size_t signal);

/// What a run computes beside what laws set: the signals that move, then the outputs.
std::vector<int> simulated_signals(const OdeSystem& system);

/// Compiles the equations. Complains (bad input) where there are no equations of motion, where an equation has no derivative of its
/// own to give, where a highest derivative stands inside a function, where what a law sets is differentiated or an input so that the
/// motion is none (input_jumps.hpp), where an equation of motion delays what moves, or where output equations contradict (outputs.hpp).
std::optional<OdeSystem> ode_system(const model::Model& model, Diagnostics& diagnostics);

}  // namespace algest::lab
