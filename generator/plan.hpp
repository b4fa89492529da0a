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
/// Of [estimator]: what rows are made of.
enum class Functional : std::uint8_t { annihilator, derivative, average };
enum class Quadrature : std::uint8_t { exact, trapezoid, simpson };
enum class Domain : std::uint8_t { z, q };

/// A signal that the user feeds, in the order of the model file.
struct Input {
    std::string name;
    std::string unit;      ///< empty: not declared
    std::string column;    ///< column of a recording that holds it; the name unless declared otherwise
    double min;            ///< samples outside [min, max] are rejected; infinite: no limit
    double max;
    bool differentiated;   ///< a parabola filter runs on it
    int wait = 0;          ///< samples that it waits for the sensor that is latest
};

/// An input some samples ago; the signals' tape reads it behind the inputs.
struct PastInput {
    int input;       ///< index into inputs
    int samples;     ///< of the period, at least 1
};

/// What one ring holds: an input, or something computed from inputs sample by sample.
struct WindowSignal {
    std::string text;      ///< the formula in canonical order, as `derive` names it
    Hold hold;             ///< of what its kernels see: linear for every signal of a decimated plan
    bool held;             ///< constant between samples as it is fed
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
    int perturbation;                  ///< 0, or i: its functional gives the coefficient c_i of the equation's perturbation, and p is 0
    Hold hold;
    std::vector<std::string> kernel;   ///< exact rational coefficients in sigma in [0,1], lowest power first, oldest sample at 0; empty: no polynomial
    std::vector<double> weights;       ///< samples of them, oldest first, each rounded once to the plan's scalar; empty with moments, or if they
                                       ///< were not asked for and follow from the kernel
};

/// What windowed moments are summed in: double, or two floats.
enum class Accumulators : std::uint8_t { float64, twofold };

/// A table's weights as what moments see (runtime's moments.hpp), each number rounded once: to the accumulators (coefficients), to the scalar (ends).
struct MomentTable {
    std::vector<double> coefficients;   ///< lowest power first, as many for every table
    std::vector<double> rests;          ///< twofold: what the coefficients leave; else empty
    double oldest;
    double newest;
    double of_one;
    double gain;
    int degree;
    int derivative;
    std::vector<double> growing;          ///< growing windows (runtime's growing_moments.hpp): power of v after power of v, each by powers of h
    std::vector<double> growing_newest;
};

/// The engine whose cost does not depend on the window.
struct Moments {
    int degree;                        ///< the largest
    std::vector<int> degrees;          ///< by window signal
    double step;
    Accumulators accumulators;
    std::vector<MomentTable> tables;   ///< by index of the plan's tables
    int shortest = 0;                  ///< samples of the shortest window, where windows grow from a start on; 0: they do not
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
    double initial;          ///< at the parameters' initial values; NaN where one of them is not declared
};

/// A way of a sensor's noise into a window signal: its standard deviation times the partial derivative.
struct NoiseChannel {
    int input;               ///< index into inputs
    int signal;              ///< index into window_signals
    int partial;             ///< index into partials; -1: constant, and in the factor
    int lag;                 ///< the input's sample k enters the signal's sample k + lag
    double factor;           ///< rounded once to the scalar
};

/// Numerators and denominator through one low-pass: x = transition x + before u_old + now u_new (runtime's ratio_filter.hpp).
struct RatioFilter {
    std::string omega_n;               ///< rad/s, exact
    std::string zeta;                  ///< exact
    std::vector<double> transition;    ///< 2 x 2, row by row, rounded once to the scalar
    std::vector<double> before;
    std::vector<double> now;
};

/// A column of the rows that is a number times one parameter or its square, which no other column of its stage has.
struct EliminationAlone {
    int parameter;
    bool squared;
    std::string exact;         ///< the coefficient as a rational
    double coefficient;        ///< rounded once to the scalar
};

/// A summand of a column: a number times powers of the parameters, of the square of one that enters its stage by squares alone.
struct EliminationSummand {
    int column;                ///< within the stage
    std::string exact;
    double coefficient;
    std::vector<int> exponents;
};

/// A term of the resultant: a number times coefficients of the extremum equations (runtime's elimination.hpp says which).
struct EliminationTerm {
    double coefficient;
    std::vector<int> factors;
};

/// Parameters that are solved for together, by one equation or more.
struct EliminationStage {
    std::vector<std::string> equations;
    int first_column;
    int columns;
    std::vector<EliminationAlone> alone;
    std::vector<EliminationSummand> summands;
    int x;                     ///< the parameter that the resultant eliminates; -1: none
    int y;                     ///< the one that it leaves; -1: all stand alone
    bool x_squared;
    bool y_squared;
    int degree_x;              ///< of the columns
    int degree_y;
    std::vector<EliminationTerm> resultant;
    int resultant_degree;      ///< in y
    int degree_of_first;       ///< of dE/dx in x
    int degree_of_second;      ///< of dE/dy in x
};

/// How the columns of the rows hang on fewer parameters, counted in sizes that are powers of two.
struct Elimination {
    std::vector<double> sizes;   ///< by parameter
    std::vector<EliminationStage> stages;
};

/// A parameter that the user asked for.
struct Parameter {
    std::string name;
    std::string unit;        ///< empty: not declared
    std::string from;        ///< in the lumped parameters, e.g. "Gamma2/Gamma1"
    double initial;          ///< held until the first ok estimate
    bool perturbation;       ///< no parameter: a coefficient of a perturbation on the window
};

/// A quantity that is averaged over operating points.
struct Averaged {
    std::string name;
    std::string unit;       ///< empty: not declared
    double tolerance;       ///< largest spread of its means over the quarters of a steady block; infinite: not asked
};

/// Rows from means over steady blocks of samples instead of from windows.
struct SteadyState {
    int block;                        ///< samples
    std::vector<Averaged> averaged;   ///< what the signals' tape reads
    Tape quantities;                  ///< inputs -> averaged quantities
    int stretches;                    ///< the input that numbers stretches; -1: none
};

/// Which side of a difference equation a column of the rows comes from, and the samples that it combines: scale * sum taps[s] f(k-n+s).
struct Combination {
    std::string name;                  ///< of the unknown; "known" for the known side
    bool input;                        ///< of the input; else of the output
    std::string scale;                 ///< exact rational
    std::vector<std::string> taps;     ///< coprime integers
};

/// How the rows of a discrete-time estimator were made (004); the unknowns are the denominator's, then the numerator's, lowest first.
struct Discrete {
    Domain domain;
    int n;
    int m;
    int numerator;
    int derivatives;
    int skip;
    int extra;
    std::string gamma;                        ///< exact rational
    std::string omega0;                       ///< 2/period, exact rational, 1/s
    bool pooled;                              ///< the equation itself, of every sample since reset (12 to 14); else levels of sums
    std::vector<std::string> multiplier;      ///< chi(k), lowest power first; empty where pooled
    std::vector<Combination> combinations;
    std::vector<std::string> filter_numerator;     ///< of the rows, in z^-1; empty: they are not filtered
    std::vector<std::string> filter_denominator;
};

struct Plan {
    std::string name;
    std::string class_name;
    std::string summary;
    std::string source;
    Scalar scalar;
    std::string period_text;   ///< exact rational, s; of the samples that are fed
    double period;             ///< s
    double rate;               ///< 1/period, rounded once to the scalar, 1/s
    Functional functional = Functional::annihilator;
    int intervals;             ///< M; a window has M + 1 samples
    int decimate = 1;          ///< periods that one sample of a window is the mean over; 1: it is a sample that was fed
    Quadrature quadrature;

    std::vector<Input> inputs;
    std::vector<PastInput> past;
    std::vector<WindowSignal> window_signals;
    std::vector<std::string> partials;   ///< what the rings beside the window signals hold: derivatives of window signals by noisy inputs
    Tape signals;              ///< inputs, then past inputs -> window signals, then partials; needs the sample before if any signal is delayed
    std::vector<Table> tables;
    std::optional<Moments> moments;    ///< empty: engine fir
    std::vector<Equation> equations;
    std::vector<Row> rows;
    std::vector<Row> perturbation;       ///< one a coefficient c_i; their residuals at the estimate
    std::vector<Lumped> lumped;
    std::vector<Parameter> parameters;
    Tape parameter_map;        ///< lumped, then residuals of the perturbation rows -> parameters, then perturbations
    Tape map_derivatives;      ///< lumped -> gradients of the parameters (parameters x unknowns), then second derivatives (packed upper triangles)
    algest::Solve solve;
    int solve_instants;        ///< instants in S(t); 0 unless robust
    double keep;               ///< least squares: factor on the old rows at each instant
    double condition_limit;
    int kept;                  ///< samples that the rings keep beyond one window
    std::vector<NoiseChannel> noise;     ///< sorted by input; empty: no uncertainty()
    double deviation_limit;    ///< 0: not asked
    double margin_over_noise = 0.0;      ///< operating points, rows of z and q: they must see every combination of the unknowns by this many times the
                                         ///< square of what noise of the means, or of the output, puts there; 0: not asked
    int output = 0;                      ///< of z and q: the window signal of the output
    double output_noise = 0.0;           ///< its declared standard deviation
    std::vector<double> noise_floor;     ///< robust: what noise may make of S(t), packed upper triangle of the unknowns; empty: not asked. Of z and q:
                                         ///< row after row, what noise of deviation 1 in the output makes of it
    bool whiten;
    std::optional<RatioFilter> ratio;
    std::optional<Elimination> elimination;   ///< with solve = elimination
    std::optional<SteadyState> steady;        ///< of the functional average; a window is then one mean
    std::optional<Discrete> discrete;
    bool normalise = false;              ///< rows are divided by their largest entry, columns tested against rounding
    std::vector<std::string> notes;   ///< what was chosen for the user, in words

    int samples() const { return intervals + 1; }
    int rings() const { return static_cast<int>(window_signals.size() + partials.size()); }
    /// That are estimated; perturbations stand behind them.
    int estimated() const { return static_cast<int>(parameters.size() - perturbation.size()); }
    /// True where uncertainty() is served.
    bool uncertain() const { return !noise.empty() && !normalise; }
    /// True of operating points whose errors are declared.
    bool points_above_noise() const { return margin_over_noise > 0.0 && !normalise; }
    /// What the signals' tape reads as its input k: a quantity that is averaged, or what is fed.
    const std::string& tape_input(int k) const {
        const std::size_t i = static_cast<std::size_t>(k);
        return steady ? steady->averaged[i].name : inputs[i].name;
    }
    int longest_wait() const {
        int longest = 0;
        for (const Input& i : inputs) longest = i.wait > longest ? i.wait : longest;
        return longest;
    }
    /// From a start or restart: the window, the instants of S(t), the samples that a first mean, a delayed model and a late sensor need before.
    int samples_to_first_estimate() const {
        if (steady) return steady->block + longest_wait();
        const int instants = (moments && moments->shortest > 0 ? moments->shortest : samples()) + (solve_instants > 0 ? solve_instants - 1 : 0);
        return (decimate > 1 ? instants * decimate + 1 : instants) + (delayed() ? 1 : 0) + delay_length() + longest_wait();
    }
    /// Samples that the lines of past inputs hold; 0: there are none.
    int delay_length() const {
        int out = 0;
        for (const PastInput& p : past) if (p.samples > out) out = p.samples;
        return out;
    }
    /// Inputs of which some past is read, in their order: each has a line.
    std::vector<int> delayed_inputs() const {
        std::vector<int> out;
        for (int i = 0; i < static_cast<int>(inputs.size()); ++i) {
            bool used = false;
            for (const PastInput& p : past) used = used || p.input == i;
            if (used) out.push_back(i);
        }
        return out;
    }
    bool delayed() const {
        for (const WindowSignal& s : window_signals) if (s.delayed) return true;
        return false;
    }
};

}  // namespace algest::plan
