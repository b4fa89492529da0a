// SPDX-License-Identifier: GPL-3.0-or-later
// [sampling] and [estimator]: times, solver, and what this version does not support.
#include "generator/model_sections.hpp"

namespace algest::model {

using exact::Rational;

namespace {

/// Drops a window that no estimator can have, after a complaint.
void check_window(Reading& reading) {
    Model& model = reading.model;
    const Rational intervals = *model.window / *model.period;
    if (intervals > most_intervals) {
        reading.file.error(model.window_at, "the window has more than " + std::to_string(most_intervals) + " periods", "choose a shorter one, or sample less often");
    } else if (intervals < 2) {
        reading.file.error(model.window_at, "the window is shorter than two periods", "choose a longer one");
    } else if (!exact::is_integer(intervals)) {
        const exact::Integer below = cln::floor1(intervals);
        reading.file.error(model.window_at, "the window is not a whole number of periods: between " + exact::text(below) + " and " + exact::text(below + 1),
                           "e.g. window = \"" + exact::text(below * *model.period) + "\", which is " + exact::text(below));
    } else {
        return;
    }
    model.window.reset();
}

/// Complains about what a model may say and this version cannot do.
void check_support(const toml::table& t, Reading& reading) {
    const Estimator& e = reading.model.estimator;
    if (e.functional != Functional::annihilator) {
        reading.file.error(*t.get("functional"), "this functional is not supported by this version", "use functional = \"annihilator\"");
    }
    if (e.solve == Solver::elimination) {
        reading.file.error(*t.get("solve"), "elimination is not supported by this version", "use square, robust or least_squares");
    }
}

/// Complains where solve_window or the quadrature does not fit the sampling.
void check_times(const toml::table& t, Reading& reading) {
    const Model& model = reading.model;
    const Estimator& e = model.estimator;
    if (!model.period) return;
    if (e.solve_window && !exact::is_integer(*e.solve_window / *model.period)) {
        reading.file.error(*t.get("solve_window"), "solve_window is not a whole number of periods", "choose a multiple of the period");
    } else if (e.solve_window && *e.solve_window / *model.period > most_intervals) {
        reading.file.error(*t.get("solve_window"), "solve_window has more than " + std::to_string(most_intervals) + " periods", "choose a shorter one");
    }
    if (e.quadrature == plan::Quadrature::simpson && model.window && cln::oddp(cln::numerator(*model.window / *model.period))) {
        reading.file.error(*t.get("quadrature"), "Simpson's rule needs an even number of periods in the window", "change the window by one period");
    }
}

}  // namespace

void read_sampling(const toml::table& root, Reading& reading) {
    const toml::table* t = reading.file.subtable(root, "sampling");
    Model& model = reading.model;
    model.sampling_at = t == nullptr ? Position{1, 1} : position(*t);
    if (t == nullptr) return;
    reading.file.known_keys(*t, {"period", "window", "growing"});
    model.period = reading.file.duration(*t, "period");
    model.window = reading.file.duration(*t, "window");
    if (t->contains("window")) model.window_at = position(*t->get("window"));
    model.growing = reading.file.boolean(*t, "growing").value_or(false);
    if (model.growing) {
        reading.file.error(*t->get("growing"), "a growing window is not supported by this version", "leave it out: the window then slides from the start");
    }
    if (model.period && model.window) check_window(reading);
}

void read_estimator(const toml::table& root, Reading& reading) {
    const toml::table* t = reading.file.subtable(root, "estimator");
    if (t == nullptr) return;
    TomlAccess& file = reading.file;
    file.known_keys(*t, {"functional", "form", "solve", "solve_window", "engine", "quadrature", "forgetting", "condition_limit"});
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
    file.choose<plan::Quadrature>(*t, "quadrature",
                                  {{"exact", plan::Quadrature::exact}, {"trapezoid", plan::Quadrature::trapezoid},
                                   {"simpson", plan::Quadrature::simpson}}, e.quadrature);
    e.form = file.whole(*t, "form", 1, 2).value_or(1);
    e.solve_window = file.duration(*t, "solve_window");
    e.condition_limit = file.positive(*t, "condition_limit");
    if (const auto f = file.positive(*t, "forgetting")) {
        if (*f > 1) file.error(*t->get("forgetting"), "'forgetting' is above 1", "1 keeps every row, 0.999 forgets slowly");
        else e.forgetting = *f;
    }
    check_support(*t, reading);
    check_times(*t, reading);
}

}  // namespace algest::model
