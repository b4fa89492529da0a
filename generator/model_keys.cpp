// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/model_keys.hpp"

namespace algest::model {

namespace {

std::vector<KeySection> all() {
    // What equations and [transfer] share.
    const Key kappa = {"kappa", "", "0", "perturbation terms that are annihilated: 1 erases a constant, 2 a ramp too", ""};
    const Key rows = {"rows", "", "(as many as make the system square)", "how many rows p = 1, 2, ..., or a list of p", ""};
    const Key scale = {"scale", "", "", "typical size of the equation's terms, where equations of different units are pooled and no noise is declared", ""};
    const Key perturbation = {"perturbation", "", "", "a name: the coefficients of the annihilated perturbation are estimated too", ""};

    // What [transfer] and [[transfer.input]] share.
    const Key unknowns = {"unknowns", "", "[]", "coefficients that are estimated; the digits behind the name are the order", ""};
    const Key known = {"known", "", "{}", "coefficients with their numbers: { a0 = 0 }", ""};

    return {
        {Where::top, "at the top", {
            {"format", "", "1", "the format of this file", "versions.md"},
            {"name", "", "(required)", "lower case, digits, `_`; names the generated files and the class", ""},
            {"summary", "", "", "one line, shown in what is generated", ""},
            {"source", "", "", "one line: where the equations come from", ""},
            {"sampling", "", "", "table: how often, how long", ""},
            {"signals", "", "(required)", "table: what is measured or commanded, an entry each", ""},
            {"constants", "", "", "table: known numbers, an entry each", ""},
            {"parameters", "", "", "table: what is estimated, an entry each", ""},
            {"transfer", "", "", "table: a transfer equation by its orders, in place of equations", ""},
            {"equation", "", "", "array of tables: the equations", ""},
            {"estimator", "", "", "table: how the rows are made and solved", ""},
            {"feedback", "", "", "array of tables: the control laws that closed the loop while recording", ""},
            {"discrete", "", "", "table: a transfer function in z or q from samples", "discrete.md"},
            {"filter", "", "", "table, in place of equations: the parabola filter as a block of its own", "derivative.md"},
        }},
        {Where::sampling, "[sampling]", {
            {"period", "s", "", "time between two samples; an estimator needs it", ""},
            {"window", "s", "", "length of the window, a whole number of periods: long against noise, short against what changes", "design.md"},
            {"decimate", "", "1", "a window's samples are means over so many periods", ""},
            {"growing", "", "false", "from a start or a refused sample on the window holds all samples, until it is full and slides; needs `engine = \"moments\"`", "engines.md"},
        }},
        {Where::signal, "[signals] NAME = { ... }", {
            {"unit", "", "(unchecked, with a warning)", "in the spelling of UDUNITS: `N.m`, `kg.m^2`, `rad/s`; `\"1\"` for a pure number", ""},
            {"hold", "", "\"linear\"", "`\"zoh\"` for a command that is constant between samples", "stator-frame.md"},
            {"noise", "the signal's", "", "standard deviation of the sensor; with it the estimator can tell its own uncertainty", "controller.md"},
            {"resolution", "the signal's", "", "step of the sensor", ""},
            {"column", "", "(NAME)", "the column of a recording that holds it", ""},
            {"initial", "the signal's", "(its first sample)", "where the machine starts: what `simulate` starts from, and what tells `discover` a sensor that is off from a load; of a hidden state: its size too", ""},
            {"scored", "", "true", "`false`: `simulate` and `discover` do not compare it", ""},
            {"min", "the signal's", "", "samples below are rejected; of a hidden state: its size", ""},
            {"max", "the signal's", "", "samples above are rejected; of a hidden state: its size", ""},
            {"formula", "", "", "computed from measured signals: `\"v_a*cos(th) + v_b*sin(th)\"`; may be differentiated. Not for simulation", ""},
            {"steady", "the signal's", "", "with `functional = \"average\"`: how far its means over the quarters of a block may differ", "operating-points.md"},
            {"lag", "samples", "0", "how late the sensor is: an estimator lets the other signals wait for it. `simulate` and `discover` ignore it", ""},
        }},
        {Where::constant, "[constants] NAME = { ... }", {
            {"value", "the constant's", "(required)", "the number", ""},
            {"unit", "", "(unchecked, with a warning)", "as of a signal", ""},
        }},
        {Where::parameter, "[parameters] NAME = { ... }", {
            {"unit", "", "(unchecked, with a warning)", "as of a signal", ""},
            {"initial", "the parameter's", "", "held until the first good estimate; where fits start; what `simulate` takes", ""},
            {"min", "the parameter's", "", "limit of fits; an estimator ignores it, elimination too", "operating-points.md"},
            {"max", "the parameter's", "", "likewise", ""},
        }},
        {Where::equation, "[[equation]]", {
            {"name", "", "(\"equation 1\", ...)", "how messages, reports and `stages` call it", ""},
            {"ode", "", "(required)", "the equation as you write it: `\"L*der(i) = v - R*i\"`", ""},
            kappa, rows, scale, perturbation,
        }},
        {Where::transfer, "[transfer]", {
            {"output", "", "\"y\"", "the signal on the left", ""},
            {"input", "", "\"u\"", "the signal on the right; several inputs are tables of their own, `[[transfer.input]]`", ""},
            {"n", "", "(required)", "order of the output's highest derivative", ""},
            {"m", "", "0", "order of the input's highest derivative, at most n", ""},
            kappa, rows, unknowns, known, scale, perturbation,
        }},
        {Where::transfer_input, "[[transfer.input]]", {
            {"signal", "", "(required)", "the input", ""},
            {"m", "", "0", "order of its highest derivative, at most n", ""},
            unknowns, known,
        }},
        {Where::estimator, "[estimator]", {
            {"functional", "", "\"annihilator\"", "`\"derivative\"` where every state is measured; `\"average\"`: means over steady states; `\"discrete\"` with `[discrete]`", "derivative.md"},
            {"form", "", "1", "of the annihilator, 1 or 2: row p integrates or differentiates p-1 times more. A square solve is the same in both", ""},
            {"solve", "", "\"square\"", "`\"robust\"`, `\"least_squares\"`, `\"elimination\"`: below", ""},
            {"solve_window", "s", "(`window`)", "of the robust form's sums", ""},
            {"engine", "", "\"fir\"", "tables of weights; `\"moments\"`, where kernels are polynomials (otherwise fir, with a note): a cost that does not depend on the window", "engines.md"},
            {"accumulators", "", "\"float\"", "of moments in single precision: two floats for each sum; `\"double\"` where the controller has a double unit", "engines.md"},
            {"quadrature", "", "\"exact\"", "`\"trapezoid\"`, `\"simpson\"`: below; for signals with hold linear", ""},
            {"forgetting", "", "1", "least squares: factor on the weight of old rows at each sample, e.g. 0.9995", ""},
            {"condition_limit", "", "(1e5; in float 8400, robust 92)", "above it an estimate is `singular`", "controller.md"},
            {"deviation_limit", "", "(0.1 with square, declared noise and initial values; else 0)", "an estimate is `singular` where noise gives an unknown a standard deviation above this part of it, or of its initial value if that is larger; 0: never", "controller.md"},
            {"uncertainty", "", "(where noise is declared, with square, robust and means)", "`false` leaves `uncertainty()` and its memory out; with means and in z and q the test against noise", "controller.md"},
            {"whiten", "", "false", "`true`: more rows than unknowns, with `square`, are weighed by the noise of their residuals", ""},
            {"ratio_filter", "", "", "`{ omega_n = 15, zeta = 0.707 }`: a low-pass on numerators and denominators of `robust`", ""},
            {"stages", "", "(all at once)", "elimination: names of equations in the order in which they are solved", "operating-points.md"},
            {"stretches", "", "", "average: the signal that numbers the stretches to be averaged, 0 outside of them", "operating-points.md"},
        }},
        {Where::ratio_filter, "[estimator] ratio_filter = { ... }", {
            {"omega_n", "rad/s", "(required)", "natural frequency of the low-pass", ""},
            {"zeta", "", "0.707", "its damping", ""},
        }},
        {Where::discrete, "[discrete]", {
            {"domain", "", "(required)", "`\"z\"` or `\"q\"`, which stays well-conditioned when sampled fast", "discrete.md"},
            {"output", "", "\"y\"", "the measured signal", ""},
            {"input", "", "\"u\"", "the commanded signal", ""},
            {"n", "", "(required)", "number of poles", ""},
            {"m", "", "(n-1)", "order of the numerator, at most n", ""},
            {"numerator", "", "(m)", "order of the estimated numerator, at most m: the zeros above it are preset", ""},
            {"derivatives", "", "(n+1)", "with respect to z: n+1 erase the initial conditions", ""},
            {"skip", "", "0", "levels of sums that are left out", ""},
            {"extra", "", "0", "rows beyond the unknowns", ""},
            {"gamma", "", "1", "1/(z - gamma) in place of sums: less forgets old samples", ""},
            {"row_filter", "", "", "`{ numerator = [0.1], denominator = [1, -0.9] }`: a filter that every row goes through", ""},
        }},
        {Where::row_filter, "[discrete] row_filter = { ... }", {
            {"numerator", "", "(required)", "coefficients in 1/z, the newest first", ""},
            {"denominator", "", "[1]", "likewise", ""},
        }},
        {Where::filter, "[filter]", {
            {"kind", "", "\"parabola\"", "the only one", "derivative.md"},
            {"signals", "", "(all)", "the signals that are filtered: a list of names", ""},
        }},
        {Where::feedback, "[[feedback]]", {
            {"signal", "", "(required)", "the signal that the controller computed", ""},
            {"law", "", "(required)", "how: `\"-Kp*x\"`, sampled every period and held. An estimator ignores it", ""},
        }},
    };
}

}  // namespace

const std::vector<KeySection>& key_sections() {
    static const std::vector<KeySection> sections = all();
    return sections;
}

std::vector<std::string> key_names(Where where) {
    std::vector<std::string> out;
    for (const KeySection& section : key_sections()) {
        if (section.where != where) continue;
        for (const Key& key : section.keys) out.push_back(key.name);
    }
    return out;
}

}  // namespace algest::model
