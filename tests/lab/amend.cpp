// SPDX-License-Identifier: GPL-3.0-or-later
// What an amendment writes beside a new parameter: a bound by its value, and a start that keeps it; and where.
#include "lab/amend.hpp"

#include <catch2/catch.hpp>

#include "tests/lab/temporary_file.hpp"

namespace {

using namespace algest;

constexpr const char* model_text = R"toml(name = "m"
[signals]
u = { unit = "N", initial = 0 }
v = { unit = "m/s", initial = 0 }
[parameters]
m = { unit = "kg", initial = 1 }
[[equation]]
ode = "m*der(v) = u"
)toml";

constexpr const char* effect_text = R"toml(name = "drag"
summary = "it drags"
shows = "a line"
reference = "none"
[enters]
units = ["N"]
[roles]
speed = "speed"
[rewrite]
kind = "add_term"
term = "-b*{speed}"
[[parameter]]
name = "b"
unit = "{equation}/({speed})"
)toml";

/// The amended text for the only place of an effect in a model.
std::string amended_by(const std::string& text, const std::string& effect, double value) {
    Diagnostics said;
    const auto model = model::read_from_text(text, "m.toml", false, said);
    test::TemporaryFolder folder;
    folder.write("effect.toml", effect);
    const auto effects = lab::read_effects({folder.path("")}, said);
    for (const auto& d : said.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(model);
    REQUIRE(effects.size() == 1);
    const auto places = lab::bindings(effects[0], *model, {true, true});
    REQUIRE(places.size() == 1);
    lab::Amendment a = lab::amendment(places[0], *model, 0);
    a.names[0].value = value;
    const std::string out = lab::amended(text, *model, a);
    UNSCOPED_INFO(out);
    CHECK(model::read_from_text(out, "m.toml", true, said));   // an initial value outside of [min, max] would be an error
    return out;
}

/// The keys of an effect with these words behind its parameter, at a value that the fit found.
std::string with(const std::string& bound, double value) {
    const std::string out = amended_by(model_text, effect_text + bound, value);
    return out.substr(out.find("b = "), out.find(" }   #") - out.find("b = "));
}

}  // namespace

TEST_CASE("a parameter's min goes into the amended model by its value, and its start does not lie below") {
    CHECK(with("", -2.5) == "b = { initial = -2.5, unit = \"N.s/m\"");
    CHECK(with("min = 0", -2.5) == "b = { initial = 0, unit = \"N.s/m\", min = 0");
    CHECK(with("min = 0", 2.5) == "b = { initial = 2.5, unit = \"N.s/m\", min = 0");
    CHECK(with("min = 0.125", 0) == "b = { initial = 0.125, unit = \"N.s/m\", min = 0.125");
    CHECK(with("min = -3", -2.5) == "b = { initial = -2.5, unit = \"N.s/m\", min = -3");
    // Six digits of 1.2345644 are less than it.
    CHECK(with("min = 1.2345644", 1.23456445) == "b = { initial = 1.2345644, unit = \"N.s/m\", min = 1.2345644");
}

TEST_CASE("new entries go behind the header of an empty table, and a constant that is let go too") {
    const std::string machine = R"toml(name = "m"
[signals]
u = { unit = "N", initial = 0 }
v = { unit = "m/s", initial = 0 }
[constants]
m = { value = 2, unit = "kg" }
)toml";
    const std::string balance = "[[equation]]\node = \"m*der(v) = u\"\n";
    const std::string let_go = R"toml(name = "wrong"
summary = "a constant is wrong"
shows = "what it multiplies"
reference = "none"
[roles]
known = "constant"
[rewrite]
kind = "free_constant"
what = "{known}"
)toml";
    for (const std::string& text : {machine + "[ parameters ]   # none yet\n" + balance, machine + balance + "[ parameters ]   # none yet"}) {   // the last line does not end
        CHECK(amended_by(text, effect_text, 3).find("# none yet\nb = { initial = 3") != std::string::npos);
        CHECK(amended_by(text, let_go, 3).find("# none yet\nm = { initial = 3, unit = \"kg\" }\n") != std::string::npos);
    }
}

TEST_CASE("an amendment in an equation that only another one brings is none without that one") {
    Diagnostics said;
    const auto model = model::read_from_text(model_text, "m.toml", false, said);
    REQUIRE(model);
    lab::Amendment term{};
    term.equations = {1};   // the model has one equation
    term.terms = {"-c*v"};
    CHECK(lab::amended(model_text, *model, term).empty());
    lab::Amendment replacement{};
    replacement.substitutions.emplace_back();
    replacement.substitutions[0].equation = 1;
    replacement.substitutions[0].what = "v";
    replacement.substitutions[0].by = "v/g";
    CHECK(lab::amended(model_text, *model, replacement).empty());
    replacement.substitutions[0].equation = 0;
    CHECK_FALSE(lab::amended(model_text, *model, replacement).empty());
}
