// SPDX-License-Identifier: GPL-3.0-or-later
// Who is named where two sets of effects explain alike.
#include "lab/precedence.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "lab/declared_start.hpp"

using namespace algest;
using lab::Contender;
using As = lab::Precedence::Standing;

namespace {

lab::Effect effect(const std::string& name, lab::Rewrite rewrite = lab::Rewrite::add_term, bool outside = false, std::vector<lab::Rival> rivals = {}) {
    lab::Effect out;
    out.name = name;
    out.rewrite = rewrite;
    out.outside = outside;
    out.rivals = std::move(rivals);
    return out;
}

/// What is set up of an amendment: its effect, its equation, and how many parameters it brings.
lab::Variant with(const std::vector<std::tuple<std::string, std::size_t, std::size_t>>& effects) {
    lab::Variant out;
    for (const char* const name : {"first", "second"}) {
        out.whole.equations.emplace_back();
        out.whole.equations.back().name = name;
    }
    for (const auto& [name, equation, parameters] : effects) {
        lab::Amendment a{};
        a.effect = name;
        a.equations = {equation};
        a.names.resize(parameters);
        out.amendments.push_back(a);
    }
    return out;
}

const std::vector<lab::Effect> library = {effect("load"), effect("friction", lab::Rewrite::add_term, false, {{"falling", "", false}}), effect("falling", lab::Rewrite::add_term, false, {{"friction", "", true}}),
                                          effect("wave", lab::Rewrite::add_term, true), effect("bias", lab::Rewrite::transform_signal, false, {{"load", "stand still"}})};
const lab::Precedence precedence(library);

}  // namespace

TEST_CASE("precedence: what adds to the machine goes before what bends the model, in pairs too") {
    const lab::Variant load = with({{"load", 0, 1}}), bias = with({{"bias", 0, 1}});
    CHECK(precedence.before({&load, 1}, {&bias, 100}));
    CHECK_FALSE(precedence.before({&bias, 100}, {&load, 1}));
    CHECK(precedence.beside({&load, 1}, {&bias, 1}) == As::as_well);
    const lab::Variant load_and_wave = with({{"load", 0, 1}, {"wave", 0, 3}}), bias_and_wave = with({{"bias", 0, 1}, {"wave", 0, 3}});
    CHECK(precedence.beside({&load_and_wave, 1}, {&bias_and_wave, 1}) == As::as_well);
    CHECK(precedence.doubt(load_and_wave, bias_and_wave).rfind("bias explains", 0) == 0);
    const lab::Variant wave = with({{"wave", 0, 3}});
    CHECK(precedence.beside({&load, 1}, {&wave, 1}) == As::nothing);   // no file calls them rivals
}

TEST_CASE("precedence: then what has less to fit, then what the files put first") {
    const lab::Variant one = with({{"load", 0, 1}}), two = with({{"friction", 0, 2}});
    CHECK(precedence.before({&one, 1}, {&two, 1}));
    CHECK(precedence.beside({&one, 1}, {&two, 1}) == As::nothing);
    CHECK(precedence.beside({&two, 1}, {&one, 1}) == As::rival);
    const lab::Variant friction = with({{"friction", 0, 1}}), falling = with({{"falling", 0, 1}});
    CHECK(precedence.before({&friction, 1}, {&falling, 1}));
    CHECK_FALSE(precedence.before({&falling, 1}, {&friction, 1}));
    CHECK(precedence.beside({&friction, 1}, {&falling, 1}) == As::as_well);
    CHECK(precedence.beside({&one, 1}, {&friction, 1}) == As::rival);
}

TEST_CASE("precedence: of one effect in two places the rows decide, where one equation lacks it and the other lacks nothing") {
    const lab::Variant here = with({{"load", 0, 1}}), there = with({{"load", 1, 1}});
    CHECK(precedence.before({&here, 14}, {&there, 1}));
    CHECK(precedence.beside({&here, 14}, {&there, 1}) == As::as_well);
    CHECK(precedence.doubt(here, there).rfind("load in 'second' explains", 0) == 0);
    CHECK_FALSE(precedence.before({&here, 8}, {&there, 1}));      // 33 to 1 is not enough
    CHECK(precedence.beside({&here, 8}, {&there, 1}) == As::rival);
    CHECK(precedence.beside({&here, 40}, {&there, 5}) == As::rival);   // both equations lack it
    CHECK(precedence.before({&here, 1000}, {&there, 20}));             // 20 leak through from the other equation
    CHECK_FALSE(precedence.before({&here, 1000}, {&there, 40}));
    const lab::Variant other = with({{"friction", 1, 1}});
    CHECK(precedence.beside({&here, 14}, {&other, 1}) == As::rival);   // another effect is another question
}

TEST_CASE("precedence: where validation tells nothing the fitted rows may, by the likelihood of independent rows") {
    const auto fitted = [](lab::Variant v, double squares) {
        v.fit.squares = {squares};
        v.fit.independent = {1000};
        return v;
    };
    const lab::Variant plain = fitted(with({{"friction", 0, 1}}), 1.0);
    const auto nearer = [&](const char* name, std::size_t parameters, double gain) { return fitted(with({{name, 0, parameters}}), std::exp(-gain / 1000)); };
    CHECK(precedence.fitted_rows_tell(nearer("falling", 3, 50), plain));
    CHECK_FALSE(precedence.fitted_rows_tell(nearer("falling", 3, 30), plain));
    CHECK_FALSE(precedence.fitted_rows_tell(plain, nearer("falling", 3, 50)));
    // What bends the model: only with no more to fit; and in between it is a rival, where a file calls it one.
    const lab::Variant load = fitted(with({{"load", 0, 1}}), 1.0);
    CHECK(precedence.fitted_rows_tell(nearer("bias", 1, 50), load));
    CHECK_FALSE(precedence.fitted_rows_tell(nearer("bias", 2, 50), load));
    const lab::Variant likely = nearer("bias", 1, 20), unlikely = nearer("bias", 1, -20);
    CHECK(precedence.beside({&load, 1}, {&likely, 1}) == As::rival);
    CHECK(precedence.beside({&load, 1}, {&unlikely, 1}) == As::as_well);
}

namespace {

/// One signal x, declared to start at 0.2 and fitted as 0.25 +- `sd` there; `bias` in its effects says that it shows 0.05 too much.
lab::Variant starting(lab::Variant v, double sd, double declared = 0.2) {
    v.model.signals.emplace_back();
    v.model.signals[0].name = "x";
    v.model.signals[0].initial = exact::from_double(declared);
    v.bench.measured = {{0.25}};
    v.bench.system.states = {{0, 0}};
    v.fit.initial = {0.25};
    v.fit.initial_sd = {sd};
    v.fit.squares = {1};
    v.fit.independent = {1000};
    if (v.amendments.back().effect == "bias") {
        v.model.parameters.emplace_back();
        v.model.parameters[0].name = "off";
        v.fit.parameters = {0.05};
        v.fit.sd = {0.75 * sd};
        v.amendments.back().substitutions = {{0, "x", "-off + x", "", lab::Part::everywhere, 0, {}}};
    }
    return v;
}

}  // namespace

TEST_CASE("precedence: the declared start tells a sensor that is off from a load, where one of the two keeps to it") {
    const auto load = [](double sd, double declared = 0.2) { return starting(with({{"load", 0, 1}}), sd, declared); };
    const auto bias = [](double sd, double declared = 0.2) { return starting(with({{"bias", 0, 1}}), sd, declared); };
    CHECK(lab::away_from_declared_start(load(0.01)).at("x") == Approx(25));                  // (0.05 / 0.01)^2
    CHECK(lab::away_from_declared_start(bias(0.01)).at("x") == Approx(0).margin(1e-9));
    CHECK(lab::away_from_declared_start(bias(0.01, 0.1)).at("x") == Approx(std::pow(0.1 / 0.0175, 2)));   // 0.01 + 0.0075: they hang together
    const lab::Variant sure = bias(0.005), truth = load(0.005), likely = bias(0.01), unlikely = load(0.01);
    CHECK(precedence.fitted_rows_tell(sure, truth));                                 // by 100
    CHECK_FALSE(precedence.fitted_rows_tell(likely, unlikely));                      // by 25
    CHECK(precedence.beside({&unlikely, 1}, {&likely, 1}) == As::rival);
    const lab::Variant at_the_sample = load(0.004, 0.25), off = bias(0.004, 0.25);
    CHECK(precedence.fitted_rows_tell(at_the_sample, off));                          // the load keeps to it: 0 against 51
    // A start that neither keeps to was not meant; nor is one asked for that the fit does not see, or that lies before its first row.
    const lab::Variant nowhere = load(0.005, 5), nowhere_too = bias(0.005, 5);
    CHECK_FALSE(precedence.fitted_rows_tell(nowhere_too, nowhere));   // 301 thousand against 902
    CHECK(precedence.beside({&nowhere, 1}, {&nowhere_too, 1}) == As::as_well);
    lab::Variant later = load(0.005);
    later.fit.begin = 10;
    CHECK(lab::away_from_declared_start(later).empty());
    CHECK(lab::away_from_declared_start(load(std::numeric_limits<double>::infinity())).empty());
    lab::Variant unseen = bias(0.005);
    unseen.fit.sd = {std::numeric_limits<double>::infinity()};
    CHECK(lab::away_from_declared_start(unseen).empty());
    CHECK_FALSE(precedence.fitted_rows_tell(unseen, truth));
    lab::Variant lagging = bias(0.005);   // what a sensor shows now may hang on what moved before: nothing is said of the start
    lagging.amendments.back().substitutions[0].by = "x + off*der(x)";
    CHECK(lab::away_from_declared_start(lagging).empty());
    lab::Variant twice = bias(0.005);     // a gain beside the bias: which comes first is not asked
    twice.amendments.push_back(twice.amendments.back());
    CHECK(lab::away_from_declared_start(twice).empty());
    lab::Variant of_an_input = bias(0.005);
    of_an_input.amendments.back().substitutions[0].what = "u";
    CHECK_FALSE(lab::corrects_a_sensor(of_an_input));
}
