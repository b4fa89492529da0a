// SPDX-License-Identifier: GPL-3.0-or-later
// A model file, read and checked (design.md, section 3). What is here is sound: names exist and are distinct, numbers are
// exact and in range, formulas parse, units are known and fit. Whether an estimator follows is for `equation` to say.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/exact.hpp"
#include "generator/formula.hpp"
#include "generator/plan.hpp"

namespace algest::model {

using exact::Rational;

struct Signal {
    std::string name;
    Position at;
    std::string unit;                 ///< empty: not declared
    plan::Hold hold = plan::Hold::linear;
    std::string column;
    std::optional<Rational> noise;    ///< standard deviation, in the unit
    std::optional<Rational> resolution;
    std::optional<Rational> initial;
    std::optional<Rational> min;
    std::optional<Rational> max;
    bool scored = true;
    std::string formula_text;         ///< of a signal that is computed from measured ones; empty: it is measured
    formula::Formula formula;
    std::optional<Rational> steady;   ///< largest spread of its means over the quarters of a steady block, in the unit
    int lag = 0;                      ///< periods by which its sensor is late; estimators let the other signals wait

    /// What the sensor is off by: its noise and its steps (uniform over a step: resolution / sqrt(12)) together. Empty where neither is declared, or both are 0.
    std::optional<Rational> deviation() const;
};

struct Constant {
    std::string name;
    Position at;
    std::string unit;
    Rational value;
};

struct Parameter {
    std::string name;
    Position at;
    std::string unit;
    std::optional<Rational> initial;
    std::optional<Rational> min;
    std::optional<Rational> max;
};

/// Which rows p of an equation: a count (p = 1 .. count), a list, or nothing said.
struct RowChoice {
    std::optional<int> count;
    std::vector<int> list;
    Position at;
};

struct Equation {
    std::string name;
    std::string file;
    Position at;                       ///< of the ode's text
    std::string ode;                   ///< as written
    std::vector<Position> places;      ///< position of each byte of `ode` in the file, and of its end
    formula::Equation sides;
    int kappa = 0;
    std::string perturbation;          ///< the name under which its coefficients on the window are given; empty: they are not
    Position perturbation_at;
    RowChoice rows;
    std::optional<Rational> scale;     ///< typical size, in the equation's unit
    Position place(int offset) const;
};

struct Feedback {
    std::string signal;
    Position at;
    std::string law_text;
    std::vector<Position> places;
    formula::Formula law;
};

enum class Functional { annihilator, discrete, derivative, average };
enum class Solver { square, robust, least_squares, elimination };

/// The name of something that another section declares.
struct Mention {
    std::string name;
    Position at;
};

struct Estimator {
    bool given = false;
    Position at;
    Functional functional = Functional::annihilator;
    int form = 1;                           ///< of the annihilator
    Solver solve = Solver::square;
    std::optional<Rational> solve_window;   ///< s
    Rational forgetting = 1;                ///< factor on the weight of old rows at each sample, least squares
    std::optional<Rational> condition_limit;
    std::optional<Rational> deviation_limit;   ///< nothing said: a default where noise_suffices sees fit; 0: none
    std::optional<bool> uncertainty;        ///< nothing said: where noise is declared and the solve allows it
    bool whiten = false;
    std::optional<Rational> omega_n;        ///< rad/s, of the ratio filter; empty: there is none
    Rational zeta = Rational(707) / 1000;   ///< as in 000
    std::vector<Mention> stages;            ///< elimination: equations in the order in which they are solved; empty: all at once
    Mention stretches;                      ///< average: the signal that numbers the stretches to be averaged; no name: steady ones are looked for
    std::string engine = "fir";
    Position engine_at;                     ///< of the section where no engine is given
    plan::Accumulators accumulators = plan::Accumulators::twofold;   ///< of single-precision moments
    plan::Quadrature quadrature = plan::Quadrature::exact;

    /// True: rows are integrals or means over [sampling] window. False: an equation has one row an instant.
    bool has_window() const { return functional != Functional::derivative; }
    bool limits_deviation() const { return deviation_limit && cln::plusp(*deviation_limit); }
};

/// [filter]: no estimator, a block that filters signals on their own.
struct Filter {
    Position at;
    std::vector<int> signals;   ///< indices, in the order of the file
};

/// [discrete]: a transfer function in z or q, identified from samples (004).
struct Discrete {
    Position at;
    plan::Domain domain = plan::Domain::q;
    std::string output;
    std::string input;
    int n = 1;
    int m = 0;                        ///< of the numerator in z, with the preset zeros
    int numerator = 0;                ///< unknowns of the numerator, less one
    int derivatives = 2;
    int skip = 0;                     ///< levels that are left out
    int extra = 0;                    ///< rows beyond the unknowns
    Rational gamma = 1;
    std::vector<Rational> filter_numerator;     ///< of the rows, in z^-1; empty: they are not filtered
    std::vector<Rational> filter_denominator;

    int unknowns() const { return n + numerator + 1; }
    int highest_level() const { return n + numerator + skip + extra; }
};

/// a0 .. a(n-1), b0 .. of z; A1 .. An, B0 .. of q.
std::vector<std::string> unknown_names(const Discrete& discrete);

struct Model {
    std::string path;
    std::string name;
    std::string summary;
    std::string source;
    std::optional<Rational> period;   ///< s
    std::optional<Rational> window;   ///< s
    Position sampling_at;
    Position window_at;
    int decimate = 1;                 ///< periods that one sample of a window is the mean over
    bool growing = false;
    Position growing_at;

    /// Between samples of a window, s; needs a period.
    Rational window_period() const { return *period * decimate; }
    std::vector<Signal> signals;
    std::vector<Constant> constants;
    std::vector<Parameter> parameters;
    std::vector<Equation> equations;  ///< a [transfer] is written out as one
    std::vector<Feedback> feedback;
    Estimator estimator;
    std::optional<Discrete> discrete;
    std::optional<Filter> filter;     ///< then there are no equations and nothing to estimate

    const Signal* signal(const std::string& name) const;
    const Constant* constant(const std::string& name) const;
    const Parameter* parameter(const std::string& name) const;
    int signal_index(const std::string& name) const;      ///< -1: none
    int parameter_index(const std::string& name) const;   ///< -1: none
};

/// Of all signals, in the order of the file.
std::vector<std::string> signal_names(const Model& model);

/// Largest orders and window that are accepted.
constexpr int largest_order = 12;
constexpr int largest_kappa = 8;
constexpr int largest_row = 40;
constexpr int most_intervals = 1000000;
constexpr int largest_decimation = 10000;
constexpr int largest_skip = 40;      ///< levels of sums, each a degree more
constexpr int most_extra_rows = 100;
constexpr int largest_lag = 1000;

/// Reads the file. Every complaint goes to `diagnostics`; nullopt if one of them is an error.
/// With strict, a missing unit is an error instead of a warning.
std::optional<Model> read(const std::string& path, bool strict, Diagnostics& diagnostics);
/// The same for the text of a file; `path` is what complaints name.
std::optional<Model> read_from_text(const std::string& text, const std::string& path, bool strict, Diagnostics& diagnostics);

}  // namespace algest::model
