// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts by the rules of docs/discover.md, and the sentences that a reader gets beside them.
#include "lab/judge.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "tests/lab/workplace.hpp"

namespace {

using namespace algest;
using lab::Selection;
using lab::Variant;
using lab::Verdict;
using test::Workplace;

const Workplace& noise_alone() {
    static const Workplace w([](std::size_t, double) { return 0.0; });
    return w;
}

/// Dry friction hidden: the residual of the nominal model has a shape.
const Workplace& friction() {
    static const Workplace w([](std::size_t, double x) { return x > 0 ? -0.3 : 0.3; });
    return w;
}

/// The variant with a white error of `gap` noise floors, 0.001 of the signal each.
Variant at(const Variant& v, double gap) {
    Variant out = v;
    out.score = {};
    out.score.error = {gap};
    out.score.floor = {1};
    out.score.rows = {1000};
    out.score.independent = {1000};
    out.score.nrmse = 0.001 * gap;
    return out;
}

/// A search that ended with this variant.
Selection selected(Variant best) { return {std::move(best), {}, {}, false}; }

struct Found {
    double gap;                ///< of what was chosen
    bool added = true;
    bool rival = false;
    double strength = 10;      ///< F statistic of the strongest candidate
};

/// The verdict on a nominal model with a gap, where the search found this.
Verdict verdict(const Workplace& w, double nominal_gap, const Found& found, lab::Yardstick yardstick = lab::Yardstick::free_run) {
    const Variant nominal = at(*w.nominal, nominal_gap);
    Selection selection = selected(at(*w.nominal, found.gap));
    if (found.added) selection.best.amendments.push_back({"effect", {0}, {"-c"}, {}, "", "", ""});
    if (found.rival) selection.rivals.push_back(selection.best);
    selection.evidence.push_back({"effect", "e", "-c", found.strength, 0, 0, found.added, false, 1});
    w.bench->measure_by(yardstick);
    const Verdict out = lab::judge(*w.bench, nominal, selection);
    w.bench->measure_by(lab::Yardstick::free_run);
    return out;
}

bool any_says(const std::vector<std::string>& sentences, const std::string& words) {
    return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

std::vector<std::string> doubts_of(const Workplace& w, double gap, Verdict v = Verdict::named) {
    return lab::doubts(*w.bench, at(*w.nominal, 9), selected(at(*w.nominal, gap)), v);
}

}  // namespace

TEST_CASE("verdict: a model at the noise lacks nothing, whatever was found") {
    CHECK(verdict(friction(), 1.14, {1.0}) == Verdict::none);
    CHECK(verdict(friction(), 1.16, {1.0}) == Verdict::named);
}

TEST_CASE("verdict: nothing added is none without a shape, unknown with one, or where rows see what noise does not make") {
    CHECK(verdict(noise_alone(), 5, {5, false}) == Verdict::none);
    CHECK(verdict(friction(), 5, {5, false}) == Verdict::unknown);
    CHECK(verdict(noise_alone(), 5, {5, false, false, 49}) == Verdict::none);
    CHECK(verdict(noise_alone(), 5, {5, false, false, 51}) == Verdict::unknown);
}

TEST_CASE("verdict: what comes down to 1.3 times the noise is named, and ambiguous beside a rival") {
    CHECK(verdict(friction(), 5, {1.29}) == Verdict::named);
    CHECK(verdict(friction(), 5, {1.29, true, true}) == Verdict::ambiguous);
    CHECK(verdict(friction(), 1.4, {1.29}) == Verdict::named);   // most of it is left, at the noise
}

TEST_CASE("verdict: above the noise a name holds below twice the noise, with 60 percent left and no shape") {
    CHECK(verdict(friction(), 100, {2.01}) == Verdict::unknown);      // two percent left, and not noise
    CHECK(verdict(noise_alone(), 4, {1.99}) == Verdict::named);
    CHECK(verdict(noise_alone(), 4, {2.01}) == Verdict::named);       // as rough as a sensor's noise: more of it than declared
    CHECK(verdict(friction(), 4, {1.99}) == Verdict::unknown);        // what is left has a shape
    CHECK(verdict(noise_alone(), 3, {1.79}) == Verdict::named);
    CHECK(verdict(noise_alone(), 3, {1.81}) == Verdict::none);        // 60 percent left, noise
    CHECK(verdict(noise_alone(), 3, {1.81, true, false, 51}) == Verdict::unknown);
}

TEST_CASE("verdict: where no equation has rows in which a shape could be looked for, nothing added is none only of a white error") {
    const Workplace& w = noise_alone();
    Variant hidden = at(*w.nominal, 1.5);
    CHECK(lab::judge(*w.bench, hidden, selected(hidden)) == Verdict::none);
    hidden.score.independent = {100};   // ten rows count as one
    CHECK(lab::judge(*w.bench, hidden, selected(hidden)) == Verdict::none);      // the rows of its equation show no shape
    hidden.bench.measured[static_cast<std::size_t>(hidden.model.signal_index("u"))].clear();
    CHECK(lab::judge(*w.bench, hidden, selected(hidden)) == Verdict::unknown);   // nobody measures what drives it: no rows
    hidden.score.independent = {1000};
    CHECK(lab::judge(*w.bench, hidden, selected(hidden)) == Verdict::none);
}

TEST_CASE("verdict: beyond twice the noise nothing added is none only where the error is as rough as a sensor's") {
    const Workplace& w = noise_alone();
    for (const double share : {0.71, 0.69}) {   // of the rows, that count as independent: 0.7 is the limit
        for (const double gap : {1.99, 2.01}) {
            Variant nominal = at(*w.nominal, gap);
            nominal.score.independent = {share * nominal.score.rows[0]};
            Selection selection = selected(nominal);
            selection.evidence.push_back({"effect", "e", "-c", 10, 0, 0, false, false, 1});
            CHECK(lab::judge(*w.bench, nominal, selection) == (share < 0.7 && gap > 2 ? Verdict::unknown : Verdict::none));
        }
    }
}

TEST_CASE("verdict: an error that is no number explains nothing") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(verdict(friction(), 10, {nan}) == Verdict::unknown);
    CHECK(verdict(friction(), 10, {nan}, lab::Yardstick::rows) == Verdict::unknown);
}

TEST_CASE("verdict: a search that was cut short does not say none") {
    const Workplace& w = noise_alone();
    Selection selection = selected(at(*w.nominal, 1.5));
    selection.cut_short = true;
    CHECK(lab::judge(*w.bench, selection.best, selection) == Verdict::unknown);
    CHECK(any_says(lab::doubts(*w.bench, selection.best, selection, Verdict::unknown), "stopped before every effect was tried"));
}

TEST_CASE("verdict: by rows 60 percent left will do, or 5 percent of what drives the equation") {
    const auto by_rows = [](const Workplace& w, double before, const Found& found) { return verdict(w, before, found, lab::Yardstick::rows); };
    CHECK(by_rows(friction(), 200, {119}) == Verdict::named);         // nrmse 0.119
    CHECK(by_rows(friction(), 200, {121}) == Verdict::unknown);
    CHECK(by_rows(noise_alone(), 200, {121}) == Verdict::none);
    CHECK(by_rows(friction(), 60, {49}) == Verdict::named);           // nrmse 0.049
    CHECK(by_rows(friction(), 60, {51}) == Verdict::unknown);
    CHECK(by_rows(friction(), 60, {49, true, true}) == Verdict::ambiguous);
}

TEST_CASE("doubts: none where all is declared and explained") {
    CHECK(doubts_of(noise_alone(), 1.0).empty());
}

TEST_CASE("doubts: an output above its noise is told of a name, and of unknown where it has no shape") {
    CHECK(doubts_of(noise_alone(), 1.29).empty());
    CHECK(any_says(doubts_of(noise_alone(), 1.31), "'x' is still 1.31 times its noise away"));
    CHECK(doubts_of(noise_alone(), 1.29, Verdict::unknown).empty());
    CHECK(any_says(doubts_of(noise_alone(), 1.31, Verdict::unknown), "is the noise that it declares too small?"));
}

TEST_CASE("doubts: no noise declared, and a resolution is a declaration") {
    const auto still = [](std::size_t, double) { return 0.0; };
    CHECK(any_says(doubts_of(Workplace(still, 1e-3, "initial = 0"), 1.0), "'x' declares no noise"));
    CHECK(doubts_of(Workplace(still, 1e-3, "resolution = 1e-3, initial = 0"), 1.0).empty());
}

TEST_CASE("doubts: runs at an extreme are a clipped sensor, single peaks are not") {
    const auto still = [](std::size_t, double) { return 0.0; };
    const Workplace clipped(still, 1e-3, "noise = 1e-3, initial = 0", [](double x) { return std::min(x, 0.7); });
    std::size_t stuck = 0;
    std::size_t run = 0;
    const std::vector<double>& x = clipped.nominal->bench.measured[1];
    for (std::size_t row = 0; row <= x.size(); ++row) {
        if (row < x.size() && x[row] == 0.7) ++run;
        else {
            if (run >= 5) stuck += run;
            run = 0;
        }
    }
    REQUIRE(stuck > Workplace::samples / 200);   // half a percent
    CHECK(any_says(doubts_of(clipped, 1.0), fmt::format("'x' stands at its largest or smallest value for {:.1f} percent", 100.0 * static_cast<double>(stuck) / Workplace::samples)));
    // One sample in five at the same largest value, never two in a row.
    std::size_t row = 0;
    const Workplace peaks(still, 1e-3, "noise = 1e-3, initial = 0", [&](double value) { return ++row % 5 == 0 ? 3.0 : value; });
    CHECK(doubts_of(peaks, 1.0).empty());
}

TEST_CASE("doubts: what turns round on a step of its sensor is not clipped, what stops there is") {
    const auto still = [](std::size_t, double) { return 0.0; };
    const auto rounded = [](double x) { return 0.1 * std::round(x / 0.1); };
    // A wave of 2 +- 0.06 on steps of 0.1: it stands on three of them, hundreds of samples on each.
    std::size_t row = 0;
    const Workplace turning(still, 1e-3, "resolution = 0.1, initial = 0", [&](double) { return rounded(2 + 0.06 * std::sin(3e-3 * static_cast<double>(++row))); });
    CHECK_FALSE(any_says(doubts_of(turning, 1.0), "clipped"));
    // A wave of 2 +- 2 that moves by up to 0.4 a sample and cannot get above 3.
    row = 0;
    const Workplace stopped(still, 1e-3, "resolution = 0.1, initial = 0", [&](double) { return rounded(std::min(3.0, 2 + 2 * std::sin(0.2 * static_cast<double>(++row)))); });
    CHECK(any_says(doubts_of(stopped, 1.0), "clipped"));
}

TEST_CASE("doubts: what was scanned, and what is hardly known") {
    const Workplace& w = noise_alone();
    Selection selection = selected(at(*w.nominal, 1));
    lab::Amendment wave{"wave", {0}, {"-a*sin(N*x)"}, {}, "", "", ""};
    wave.names.push_back({"a", "1/s", 0, std::nullopt, false});
    wave.names.push_back({"N", "1", 4, std::nullopt, true});
    selection.best.amendments.push_back(wave);
    const auto with_sd = [&](double sd, Verdict v) {
        selection.best.fit.sd = {sd, 0.01};
        return lab::doubts(*w.bench, at(*w.nominal, 9), selection, v);
    };
    for (const Verdict v : {Verdict::named, Verdict::ambiguous}) {
        CHECK(with_sd(0.59, v) == std::vector<std::string>{"N = 4 was scanned, not fitted: it is a constant of the amended model"});   // a = 2
        CHECK(any_says(with_sd(0.61, v), "a = 2 1/s is known to 0.61 1/s only"));
        CHECK(any_says(with_sd(std::numeric_limits<double>::infinity(), v), "the data do not see a, whose value is where the fit stopped"));
    }
    CHECK(with_sd(5, Verdict::unknown).empty());
}

TEST_CASE("doubts: rows in place of the long run") {
    const Workplace& w = noise_alone();
    w.bench->measure_by(lab::Yardstick::rows);
    const auto said = lab::doubts(*w.bench, at(*w.nominal, 200), selected(at(*w.nominal, 50)), Verdict::named);
    w.bench->measure_by(lab::Yardstick::free_run);
    REQUIRE(said.size() == 1);   // floors of outputs are no measure of rows
    CHECK(any_says(said, "of which 5 percent are left (before: 20 percent"));
}

TEST_CASE("a recording that shows nothing is refused") {
    const auto still = [](std::size_t, double) { return 0.0; };
    const auto complaint = [](const Workplace& w) {
        Diagnostics said;
        const bool excited = lab::excited(*w.bench, *w.nominal, said);
        CHECK(excited == !said.has_errors());
        return excited ? std::string() : said.sorted().at(0).what;
    };
    CHECK(complaint(noise_alone()).empty());
    CHECK(complaint(Workplace(still, 1e-3, "noise = 1e-3, initial = 0", [](double) { return 0.25; })) == "column 'x' is 0.25 from end to end");
    CHECK(complaint(Workplace(still, 1e-3, "noise = 1e-3, initial = 0", [](double x) { return 1e-3 * x; })) == "no output rises above its noise: the machine was not excited");
}
