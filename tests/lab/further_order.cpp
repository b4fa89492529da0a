// SPDX-License-Identifier: GPL-3.0-or-later
// Further orders of a wave over the position: one that is hidden here stands out, noise does not.
#include "lab/further_order.hpp"

#include "tests/lab/workplace.hpp"

namespace {

using namespace algest;

constexpr const char* wave = R"toml(name = "wave"
summary = "a wave over the position"
shows = "it repeats"
reference = "none"
[enters]
units = ["m/s"]
[roles]
position = "own"
[rewrite]
kind = "add_term"
term = "-As*sin(N*{position}) - Ac*cos(N*{position})"
[[parameter]]
name = "As"
unit = "{equation}"
[[parameter]]
name = "Ac"
unit = "{equation}"
[[scan]]
name = "N"
unit = "1/m"
from = 1
to = 121
step = 3          # x goes from -1.3 to 1.3: nearer ones are one line
)toml";

/// The same of one parameter.
std::string sine_alone() {
    std::string out = wave;
    out.erase(out.find("[[parameter]]\nname = \"Ac\""), out.find("[[scan]]") - out.find("[[parameter]]\nname = \"Ac\""));
    const std::string cosine = " - Ac*cos(N*{position})";
    return out.erase(out.find(cosine), cosine.size());
}

/// What stands out beside order 7 of a machine with orders 7 and 16; `second`: the amplitude of the latter, of a driving side of 1.7 rms.
std::optional<lab::Candidate> beside_seven(double second, unsigned seed = 3, const std::string& effect = wave) {
    const test::Workplace place([&](std::size_t, double x) { return -0.5 * std::sin(7 * x) - second * std::cos(16 * x); }, 1e-3, "noise = 1e-3, initial = 0", [](double x) { return x; }, seed);
    Diagnostics said;
    const auto effects = lab::read_effects({[&] { place.folder.write("wave.toml", effect); return place.folder.path(""); }()}, said);
    for (const auto& d : said.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(effects.size() == 1);
    const auto where = lab::bindings(effects[0], place.nominal->model, {true, true});
    REQUIRE(where.size() == 1);
    const lab::Amendment seven = lab::amendment(where[0], place.nominal->model, 7);
    auto v = place.bench->prepare(lab::amended(place.nominal->text, place.nominal->whole, seven), {seven}, said);
    REQUIRE(v);
    v->fit = {{2, 3, 0.5, 0}, {}, v->bench.initial, 0, true, 0};
    v->fit.parameters.resize(v->model.parameters.size());
    return lab::further_order(*place.bench, *v, seven, effects[0]);
}

}  // namespace

TEST_CASE("a further order is found beside the first, and none where there is none") {
    const auto found = beside_seven(0.1);
    REQUIRE(found);
    CHECK(found->scan == 16);
    CHECK(found->strength > 20);   // chance reaches 9 once in a thousand lines
    CHECK_FALSE(beside_seven(0.0));
    CHECK_FALSE(beside_seven(0.1, 3, sine_alone()));   // what noise takes by one parameter is not exponential
}

TEST_CASE("a further order is chance's in one search of a hundred") {
    int false_ones = 0;
    for (unsigned seed = 100; seed < 200; ++seed) {
        const auto found = beside_seven(0.0, seed);
        UNSCOPED_INFO("seed " << seed << (found ? ": found" : ""));
        false_ones += found ? 1 : 0;
    }
    CHECK(false_ones <= 4);   // of a rate of one in a hundred more than four come once in three hundred such tests
}

TEST_CASE("the strength of an order is an F statistic") {
    // 10 of 100 windows with 2 unknowns fall to 5 with 4: each of the two takes 2.5, noise has 5/96.
    CHECK(lab::f_statistic({{}, 10, 100, 2}, {{}, 5, 100, 4}) == Approx(48));
}
