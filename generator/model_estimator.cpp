// SPDX-License-Identifier: GPL-3.0-or-later
// [sampling] and [estimator]: times, solver, and what this version does not support.
#include "generator/model_keys.hpp"
#include "generator/model_sections.hpp"

#include <algorithm>

namespace algest::model {

using exact::Rational;

namespace {

/// As a model file has it: a decimal, or a fraction in quotation marks.
std::string written(const Rational& value) {
    const std::string text = exact::decimal(value);
    return text.find('/') == std::string::npos ? text : '"' + text + '"';
}

/// Drops a window that no estimator can have, after a complaint.
void check_window(Reading& reading) {
    Model& model = reading.model;
    const Rational intervals = *model.window / model.window_period();
    const std::string period = model.decimate > 1 ? "decimated period" : "period";
    if (intervals > most_intervals) {
        reading.file.error(model.window_at, "the window has more than " + std::to_string(most_intervals) + " " + period + "s", "choose a shorter one, or sample less often");
    } else if (intervals < 2) {
        reading.file.error(model.window_at, "the window is shorter than two " + period + "s", "choose a longer one");
    } else if (!exact::is_integer(intervals)) {
        const exact::Integer below = cln::floor1(intervals);
        reading.file.error(model.window_at, "the window is not a whole number of " + period + "s: between " + exact::text(below) + " and " + exact::text(below + 1),
                           "e.g. window = " + written(below * model.window_period()) + ", which is " + exact::text(below));
    } else {
        return;
    }
    model.window.reset();
}

/// Complains where something is asked of the sensors' noise that the solve cannot give.
void check_noise(const toml::table& t, Reading& reading) {
    const Estimator& e = reading.model.estimator;
    const std::vector<Signal>& signals = reading.model.signals;
    const bool noisy = std::any_of(signals.begin(), signals.end(), [](const Signal& s) { return s.deviation().has_value(); });
    if (e.whiten && e.solve != Solver::square) {
        reading.file.error(*t.get("whiten"), "whiten is for the rows of one instant: solve = \"square\" with more rows than unknowns", "use solve = \"square\", or leave it out");
    }
    const auto asked = [&](const char* key, bool by) {
        if (!by) return;
        const bool pooled = e.solve == Solver::least_squares || e.solve == Solver::elimination;
        if (pooled && e.functional == Functional::average) {
            if (!noisy && std::none_of(signals.begin(), signals.end(), [](const Signal& s) { return s.steady && !cln::zerop(*s.steady); })) {
                reading.file.error(*t.get(key), std::string(key) + " needs the errors of the means", "declare noise = ... or steady = ... for the measured signals, in their unit");
            }
        } else if (pooled) {
            reading.file.error(*t.get(key), std::string(key) + " is not to be had with " + (e.solve == Solver::elimination ? "elimination" : "least_squares") + ", which keeps no window of what it absorbed", "use square or robust, or leave it out");
        } else if (e.solve == Solver::robust && !e.has_window()) {
            reading.file.error(*t.get(key), std::string(key) + " is not to be had with robust rows of single instants", "use solve = \"square\", or leave it out");
        } else if (!noisy) {
            reading.file.error(*t.get(key), std::string(key) + " needs the noise of the sensors", "declare noise = ... for the measured signals, in their unit");
        }
    };
    asked("deviation_limit", e.limits_deviation());
    asked("uncertainty", e.uncertainty.value_or(false));
    asked("whiten", e.whiten && e.solve == Solver::square);
    if (!e.uncertainty.value_or(true) && (e.whiten || e.limits_deviation())) {
        reading.file.error(*t.get("uncertainty"), "uncertainty = false leaves out what whiten and deviation_limit need", "leave it out");
    }
}

/// Complains about what belongs to windows, where rows hold at single instants.
void check_instants(const toml::table& t, Reading& reading) {
    const Model& model = reading.model;
    if (model.estimator.has_window()) return;
    const auto refuse = [&](Position at, const std::string& what) { reading.file.error(at, what + ", and this functional has rows of single instants", "leave it out"); };
    if (model.window) refuse(model.window_at, "a window is for integrals");
    if (model.decimate > 1) refuse(model.sampling_at, "decimate is for windows");
    for (const char* key : {"form", "quadrature", "engine"}) if (t.contains(key)) refuse(position(*t.get(key)), std::string(key) + " is for windows");
    if (model.estimator.solve == Solver::robust && !model.estimator.solve_window) {
        reading.file.error(*t.get("solve"), "robust without solve_window", "add solve_window = 0.2, in seconds: how long S(t) sums");
    }
}

void read_ratio_filter(const toml::table& t, Reading& reading) {
    TomlAccess& file = reading.file;
    const toml::table* filter = file.subtable(t, "ratio_filter");
    if (filter == nullptr) return;
    Estimator& e = reading.model.estimator;
    file.known_keys(*filter, key_names(Where::ratio_filter));
    e.omega_n = file.positive(*filter, "omega_n");
    if (!filter->contains("omega_n")) file.error(*filter, "a ratio filter without omega_n", "write ratio_filter = { omega_n = 15, zeta = 0.707 }, omega_n in rad/s");
    if (const auto zeta = file.positive(*filter, "zeta")) {
        if (*zeta > 10) file.error(*filter->get("zeta"), "'zeta' is above 10", "0.707 settles soonest");
        else e.zeta = *zeta;
    }
    if (e.solve != Solver::robust) {
        file.error(*t.get("ratio_filter"), "a ratio filter needs solve = \"robust\": only the determinant of S(t) keeps its sign", "use solve = \"robust\", or leave the filter out");
    }
}

void read_stages(const toml::table& t, Reading& reading) {
    Estimator& e = reading.model.estimator;
    if (t.contains("stages")) {
        for (PlacedText& name : reading.file.strings(t, "stages", "[\"power\", \"voltage\"]")) e.stages.push_back({std::move(name.text), name.at});
        if (e.solve != Solver::elimination) reading.file.error(*t.get("stages"), "stages is for solve = \"elimination\"", "use solve = \"elimination\", or leave it out");
    }
    if (const auto name = reading.file.string(t, "stretches")) {
        e.stretches = {*name, position(*t.get("stretches"))};
        if (e.functional != Functional::average) reading.file.error(*t.get("stretches"), "stretches is for functional = \"average\"", "use functional = \"average\", or leave it out");
    }
}

/// Averages are rows of their own: what shapes windows, and what needs many of them, does not fit.
void check_average(const toml::table& t, Reading& reading) {
    const Model& model = reading.model;
    const Estimator& e = model.estimator;
    if (e.solve != Solver::least_squares && e.solve != Solver::elimination) {
        reading.file.error(t.contains("solve") ? position(*t.get("solve")) : position(t), "averages are pooled over operating points", "use solve = \"least_squares\" or \"elimination\"");
    }
    if (model.decimate > 1) reading.file.error(model.sampling_at, "decimate beside functional = \"average\", which averages already", "leave it out");
    if (model.period && model.window && *model.window / *model.period < 4) {
        reading.file.error(model.window_at, "a steady state is told by the four quarters of the window, which has fewer samples", "choose a window of at least four periods");
    }
    const bool told = std::any_of(model.signals.begin(), model.signals.end(), [](const Signal& s) { return s.steady.has_value(); });
    if (!told && e.stretches.name.empty()) {
        reading.file.error(*t.get("functional"), "nothing says when the machine is steady", "give a signal steady = ..., the drift within a window that still is, in its unit; or name a signal that numbers the stretches: stretches = \"NAME\"");
    }
}

/// Complains where solve_window or the quadrature does not fit the sampling.
void check_times(const toml::table& t, Reading& reading) {
    const Model& model = reading.model;
    const Estimator& e = model.estimator;
    if (!model.period) return;
    if (e.omega_n && *e.omega_n * *model.period > 1) {
        reading.file.error(*t.get("ratio_filter"), "the ratio filter is faster than the samples: omega_n is above 1/period", "choose omega_n well below " + exact::decimal(1 / *model.period) + " rad/s");
    }
    if (e.solve_window && !exact::is_integer(*e.solve_window / model.window_period())) {
        reading.file.error(*t.get("solve_window"), model.decimate > 1 ? "solve_window is not a whole number of decimated periods" : "solve_window is not a whole number of periods",
                           "choose a multiple of " + exact::decimal(model.window_period()) + " s");
    } else if (e.solve_window && *e.solve_window / model.window_period() > most_intervals) {
        reading.file.error(*t.get("solve_window"), "solve_window has more than " + std::to_string(most_intervals) + " periods", "choose a shorter one");
    }
    if (e.quadrature == plan::Quadrature::simpson && model.window && cln::oddp(cln::numerator(*model.window / model.window_period()))) {
        reading.file.error(*t.get("quadrature"), "Simpson's rule needs an even number of periods in the window", "change the window by one period");
    }
}

}  // namespace

void read_sampling(const toml::table& root, Reading& reading) {
    const toml::table* t = reading.file.subtable(root, "sampling");
    Model& model = reading.model;
    model.sampling_at = t == nullptr ? Position{1, 1} : position(*t);
    if (t == nullptr) return;
    reading.file.known_keys(*t, key_names(Where::sampling));
    model.period = reading.file.duration(*t, "period");
    model.window = reading.file.duration(*t, "window");
    if (t->contains("window")) model.window_at = position(*t->get("window"));
    model.decimate = reading.file.whole(*t, "decimate", 1, largest_decimation).value_or(1);
    model.growing = reading.file.boolean(*t, "growing").value_or(false);
    if (model.growing) model.growing_at = position(*t->get("growing"));
    if (model.period && model.window) check_window(reading);
}

void read_estimator(const toml::table& root, Reading& reading) {
    const toml::table* t = reading.file.subtable(root, "estimator");
    if (t == nullptr) return;
    TomlAccess& file = reading.file;
    file.known_keys(*t, key_names(Where::estimator));
    Estimator& e = reading.model.estimator;
    e.given = true;
    e.at = position(*t);
    file.choose<Functional>(*t, "functional",
                            {{"annihilator", Functional::annihilator}, {"discrete", Functional::discrete},
                             {"derivative", Functional::derivative}, {"average", Functional::average}}, e.functional);
    file.choose<Solver>(*t, "solve",
                        {{"square", Solver::square}, {"robust", Solver::robust}, {"least_squares", Solver::least_squares},
                         {"elimination", Solver::elimination}}, e.solve);
    file.choose<std::string>(*t, "engine", {{"fir", "fir"}, {"moments", "moments"}}, e.engine);
    e.engine_at = t->contains("engine") ? position(*t->get("engine")) : e.at;
    file.choose<plan::Accumulators>(*t, "accumulators", {{"float", plan::Accumulators::twofold}, {"double", plan::Accumulators::float64}}, e.accumulators);
    file.choose<plan::Quadrature>(*t, "quadrature",
                                  {{"exact", plan::Quadrature::exact}, {"trapezoid", plan::Quadrature::trapezoid},
                                   {"simpson", plan::Quadrature::simpson}}, e.quadrature);
    e.form = file.whole(*t, "form", 1, 2).value_or(1);
    e.solve_window = file.duration(*t, "solve_window");
    e.condition_limit = file.positive(*t, "condition_limit");
    e.deviation_limit = file.not_negative(*t, "deviation_limit");
    e.uncertainty = file.boolean(*t, "uncertainty");
    e.whiten = file.boolean(*t, "whiten").value_or(false);
    read_ratio_filter(*t, reading);
    check_noise(*t, reading);
    if (const auto f = file.positive(*t, "forgetting")) {
        if (*f > 1) file.error(*t->get("forgetting"), "'forgetting' is above 1", "1 keeps every row, 0.999 forgets slowly");
        else e.forgetting = *f;
    }
    read_stages(*t, reading);
    if (e.functional == Functional::average) check_average(*t, reading);
    check_instants(*t, reading);
    check_times(*t, reading);
}

}  // namespace algest::model
