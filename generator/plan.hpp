// SPDX-License-Identifier: GPL-3.0-or-later
// The estimator as data: signals, windows, rows, solver, parameter map. Everything downstream reads only this.
// Plain data, no GiNaC: whoever runs an estimator on the host includes this and the runtime.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algest/estimator.hpp"
#include "generator/tape.hpp"

namespace algest::plan {

enum class Scalar : std::uint8_t { float64, float32 };
enum class Hold : std::uint8_t { zoh, linear };
enum class Quadrature : std::uint8_t { exact, trapezoid, simpson };

/// A signal that the user feeds, in the order of the model file.
struct Input {
    std::string name;
    std::string unit;      ///< empty: not declared
    std::string column;    ///< column of a recording that holds it; the name unless declared otherwise
    double min;            ///< samples outside [min, max] are rejected; infinite: no limit
    double max;
    bool differentiated;   ///< a parabola filter runs on it
};

/// What one ring holds: an input, or something computed from inputs sample by sample.
struct WindowSignal {
    std::string text;      ///< the formula in canonical order, as `derive` names it
    Hold hold;
    bool delayed;          ///< one sample late, like all signals of an equation with a derivative inside a nonlinearity
};

/// One kernel integrated against a hold: the weights of one functional on a window.
struct Table {
    std::string name;                  ///< of the functional, e.g. "F_1_2_linear": derivative, row p, hold
    int n;
    int kappa;
    int form;                          ///< of the annihilator
    int derivative;
    int p;
    Hold hold;
    std::vector<std::string> kernel;   ///< exact rational coefficients in sigma in [0,1], lowest power first, oldest sample at 0
    std::vector<double> weights;       ///< samples of them, oldest first, each rounded once to the plan's scalar; empty if they were not asked for
};

/// One term of a row identity  sum theta_l K_l[f_l] = K_0[f_0].
struct RowTerm {
    int lumped;                        ///< index of the lumped parameter; -1: the known side
    int signal;                        ///< index into window_signals; -1: the constant 1
    int derivative;
    int table;                         ///< index into tables; -1 for the constant 1
    std::string coefficient;           ///< exact rational c: the functional is c T^-derivative times that of the table
    double factor;                     ///< c T^-derivative times the row's weight, rounded once to the scalar;
                                       ///< for the constant 1 its exact integral is included
    std::vector<std::string> kernel;   ///< coefficient times the table's kernel
};

struct Row {
    int equation;
    int p;
    std::vector<RowTerm> terms;
};

/// One summand of Pi applied to s^i Y(s):  coefficient s^power Y^(derivative_in_s).
struct LeibnizTerm {
    std::string coefficient;
    int power;
    int derivative_in_s;
};

/// Pi applied to s^i Y(s), i = 0 .. n.
struct Annihilated {
    int p;                                           ///< the row that it belongs to; 0: all of them (form 1)
    std::vector<std::vector<LeibnizTerm>> leibniz;   ///< by derivative order i
};

/// One product parameter * der(signal, order) of an equation brought to the form sum = 0.
struct OperatorTerm {
    std::string parameter;   ///< text of the coefficient in lumped parameters and numbers, e.g. "Gamma2" or "-1"
    std::string signal;
    int derivative;
};

struct Equation {
    std::string name;
    std::string ode;         ///< as the user wrote it, or the transfer equation written out
    int n;
    int kappa;
    bool divided;            ///< by its leading coefficient
    std::string leading;     ///< that coefficient
    bool delayed;
    std::vector<OperatorTerm> operators;
    int form;                             ///< of the annihilator
    std::vector<Annihilated> annihilated;
};

/// An unknown of the rows.
struct Lumped {
    std::string name;        ///< Gamma1, Gamma2, ...
    std::string meaning;     ///< in the physical parameters, e.g. "R/L"
};

/// A parameter that the user asked for.
struct Parameter {
    std::string name;
    std::string unit;        ///< empty: not declared
    std::string from;        ///< in the lumped parameters, e.g. "Gamma2/Gamma1"
    double initial;          ///< held until the first ok estimate
};

struct Plan {
    std::string name;
    std::string class_name;
    std::string summary;
    std::string source;
    Scalar scalar;
    std::string period_text;   ///< exact rational, s
    double period;             ///< s
    double rate;               ///< 1/period, rounded once to the scalar, 1/s
    int intervals;             ///< M; a window has M + 1 samples
    Quadrature quadrature;

    std::vector<Input> inputs;
    std::vector<WindowSignal> window_signals;
    Tape signals;              ///< inputs -> window signals; needs the sample before if any signal is delayed
    std::vector<Table> tables;
    std::vector<Equation> equations;
    std::vector<Row> rows;
    std::vector<Lumped> lumped;
    std::vector<Parameter> parameters;
    Tape parameter_map;        ///< lumped -> parameters
    algest::Solve solve;
    int solve_instants;        ///< instants in S(t); 0 unless robust
    double keep;               ///< least squares: factor on the old rows at each instant
    double condition_limit;
    std::vector<std::string> notes;   ///< what was chosen for the user, in words

    int samples() const { return intervals + 1; }
    /// From a start or restart: the window, the instants of S(t), the sample that primes a delayed model.
    int samples_to_first_estimate() const { return samples() + (solve_instants > 0 ? solve_instants - 1 : 0) + (delayed() ? 1 : 0); }
    bool delayed() const {
        for (const WindowSignal& s : window_signals) if (s.delayed) return true;
        return false;
    }
};

}  // namespace algest::plan
