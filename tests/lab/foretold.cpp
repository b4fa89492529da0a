// SPDX-License-Identifier: GPL-3.0-or-later
// The unseen stretch as the judge of one effect, where the validation rows speak for nothing.
#include "lab/foretold.hpp"

#include <catch2/catch.hpp>

#include "tests/lab/workplace.hpp"

namespace {

using namespace algest;
using test::Workplace;

constexpr std::size_t trained = Workplace::samples * 7 / 10;   ///< rows, unless said otherwise on the command line

/// The nominal model of a workplace, and beside it a model with one more term, fitted to the first training rows.
struct Asked {
    explicit Asked(const std::function<double(std::size_t, double)>& hidden) : place(hidden, 1e-3, "initial = 0"), selection{*place.nominal, {}, {}, false} {
        place.bench->begin_search();
        place.bench->fit_and_score(*place.nominal, place.nominal->fit.parameters, place.nominal->fit.initial);
        selection.best = *place.nominal;
        add("cubic", "c*x^3");
        add("square", "c*x^2");
    }

    void add(const std::string& effect, const std::string& term) {
        lab::Amendment amendment;
        amendment.effect = effect;
        std::string text = place.nominal->text;
        text.replace(text.find("- a*x"), 5, "- a*x - " + term);
        text.replace(text.find("[[equation]]"), 0, "c = { initial = 0 }\n");
        auto v = place.bench->prepare(text, {amendment}, place.said);
        REQUIRE(v);
        std::vector<double> start = place.nominal->fit.parameters;
        start.push_back(0);
        place.bench->fit_and_score(*v, start, place.nominal->fit.initial);
        selection.tried.push_back({std::move(*v), {selection.evidence.size()}});
        selection.evidence.push_back({effect, "", term, 0, 0, 0, false, false, 1});
    }

    bool chose() { return lab::choose_what_foretells(*place.bench, *place.nominal, selection); }

    Workplace place;
    lab::Selection selection;
};

}  // namespace

TEST_CASE("foretold: the effect that explains training and test stretch is chosen, and its rival stays behind") {
    Asked asked([](std::size_t, double x) { return -1.5 * x * x * x; });
    REQUIRE(asked.chose());
    CHECK(asked.selection.best.amendments.back().effect == "cubic");
    CHECK(asked.selection.evidence[0].chosen);
    CHECK_FALSE(asked.selection.evidence[1].chosen);
    CHECK(asked.selection.rivals.empty());
    REQUIRE(asked.selection.as_well.size() == 1);
    CHECK(asked.selection.as_well[0].find("the test stretch was asked once") != std::string::npos);
}

TEST_CASE("foretold: what acts in the training stretch alone is refused by the test stretch") {
    Asked asked([](std::size_t row, double x) { return row < trained ? -1.5 * x * x * x : 0.0; });
    CHECK_FALSE(asked.chose());
    CHECK(asked.selection.best.amendments.empty());
    CHECK_FALSE(asked.selection.evidence[0].chosen);
}

TEST_CASE("foretold: nothing is chosen where an effect makes the training error hardly smaller") {
    Asked asked([](std::size_t, double) { return 0.0; });
    CHECK_FALSE(asked.chose());
}

TEST_CASE("foretold: two that the training stretch does not tell apart are rivals") {
    Asked asked([](std::size_t, double x) { return -1.5 * x * x * x; });
    asked.add("cubic_again", "c*x^3");
    REQUIRE(asked.chose());
    CHECK(asked.selection.rivals.size() == 1);
}
