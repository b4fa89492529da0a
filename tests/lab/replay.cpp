// SPDX-License-Identifier: GPL-3.0-or-later
// Replay: columns to inputs, the stretch, the period, the summary, the CSV.
#include "lab/replay.hpp"

#include <catch2/catch.hpp>

#include <string>

#include "tests/lab/plans.hpp"
#include "tests/lab/temporary_file.hpp"

using namespace algest;
using namespace std::string_literals;

namespace {

const test::TemporaryFolder folder;

lab::Recording recording(std::string_view text) {
    Diagnostics diagnostics;
    auto r = lab::read_recording(folder.write("r.csv", text), diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(r);
    return *r;
}

// y = 2, 2, 2, 2, 4, 2 V and u in mA: windows of three samples, weights 1/4, 1/2, 1/4, from the third row on:
// mean y = 2, 2, 2.5, 3; mean u = 6, 6, 7.5, 15, and 0 from the sixth row on the means move by 0.25 u.
const std::string text =
    "u [mA],flag,t [s],y [V]\n"
    "6000,0,10,2\n6000,0,10.25,2\n6000,0,10.5,2\n6000,0,10.75,2\n12000,0,11,4\n30000,0,11.25,2\n";

std::string refusal(const plan::Plan& plan, const lab::Recording& r, lab::Stretch stretch = {}) {
    Diagnostics diagnostics;
    CHECK_FALSE(lab::replay(plan, r, stretch, diagnostics));
    REQUIRE(diagnostics.sorted().size() == 1);
    return diagnostics.sorted()[0].text().substr(r.file.size());
}

}  // namespace

TEST_CASE("a replay gives status, condition and parameters at every sample, in the model's units") {
    const plan::Plan plan = test::conductance();
    Diagnostics diagnostics;
    const auto replay = lab::replay(plan, recording(text), {}, diagnostics);
    REQUIRE(replay);
    REQUIRE(replay->samples() == 6);
    CHECK(replay->t.front() == 10.0);
    CHECK(replay->status ==
          std::vector<Status>{Status::filling, Status::filling, Status::ok, Status::ok, Status::ok, Status::ok});
    CHECK(replay->parameter(0, 0) == 7.0);
    CHECK(replay->parameter(2, 0) == Approx(3.0).epsilon(1e-15));
    // mean y = (2 + 2 * 2 + 4) / 4 = 2.5, mean u = (6 + 2 * 6 + 12) / 4 = 7.5
    CHECK(replay->parameter(4, 0) == Approx(3.0).epsilon(1e-15));
    // mean y = (2 + 2 * 4 + 2) / 4 = 3, mean u = (6 + 2 * 12 + 30) / 4 = 15
    CHECK(replay->parameter(5, 0) == Approx(5.0).epsilon(1e-15));
    CHECK(replay->parameter(5, 1) == Approx(0.2).epsilon(1e-15));

    const lab::ReplaySummary summary = lab::summarise(*replay);
    CHECK(summary.count == std::array<std::size_t, 4>{2, 4, 0, 0});
    CHECK(summary.last[0] == Approx(5.0).epsilon(1e-15));
    CHECK(summary.median[0].value() == Approx(3.0).epsilon(1e-15));  // of 3, 3, 3, 5: not of the initial 7
    CHECK(summary.condition_median == 1.0);
    CHECK(summary.condition_last == 1.0);
}

TEST_CASE("the median of an even number of samples is the mean of the two in the middle") {
    const plan::Plan plan = test::conductance();
    Diagnostics diagnostics;
    const auto replay = lab::replay(plan, recording(text), {10.5, 99.0}, diagnostics);
    REQUIRE(replay);
    CHECK(replay->samples() == 4);  // both ends included, t as in the file
    CHECK(lab::summarise(*replay).count == std::array<std::size_t, 4>{2, 2, 0, 0});
    CHECK(lab::summarise(*replay).median[0].value() == Approx(4.0));  // of 3 and 5
}

TEST_CASE("without an ok sample there is no median and no condition") {
    const plan::Plan plan = test::conductance();
    Diagnostics diagnostics;
    const auto replay = lab::replay(plan, recording("t [s],y [V],u [A]\n0,0,1\n0.25,0,1\n0.5,0,1\n"), {}, diagnostics);
    REQUIRE(replay);
    const lab::ReplaySummary summary = lab::summarise(*replay);
    CHECK(summary.count == std::array<std::size_t, 4>{2, 0, 1, 0});
    CHECK_FALSE(summary.median[0]);
    CHECK_FALSE(summary.last[0]);
    CHECK_FALSE(summary.condition_median);
    CHECK_FALSE(summary.condition_last);
}

TEST_CASE("the CSV of a replay reads back to the same bits, in double and in float") {
    plan::Plan plan = test::conductance();
    plan.parameters[1].name = "R, total";
    Diagnostics diagnostics;
    const std::string data = "t [s],y [V],u [A]\n0,2,6\n0.25,2,6\n0.5,2,6\n0.75,0,-1e400\n"s;
    const auto r = recording(data.substr(0, data.rfind("0.75")));
    const std::string rows = "0,filling,,7,8\n0.25,filling,,7,8\n0.5,ok,1,3,";
    const std::string head = "t [s],status,condition,G [1/ohm],\"R, total [ohm]\"\n";
    CHECK(lab::replay_csv(plan, *lab::replay(plan, r, {}, diagnostics)) == head + rows + "0.3333333333333333\n");
    plan.scalar = plan::Scalar::float32;
    CHECK(lab::replay_csv(plan, *lab::replay(plan, r, {}, diagnostics)) == head + rows + "0.33333334\n");
}

TEST_CASE("a recording that does not fit the model is refused with what would") {
    plan::Plan plan = test::conductance();
    const auto r = recording(text);
    CHECK(refusal(plan, r, {10.9, 12.0}) ==
          ":7:1: error: 2 samples between --from and --to, and the estimator `by_hand` gives its first estimate after 3 "
          "(0.75 s); "
          "a longer stretch; the recording goes from 10 s to 11.25 s");
    plan.period = 0.2499;  // 4e-4 away
    CHECK(refusal(plan, r).find(":1:13: error: the recording is sampled every 0.25 s, the model `by_hand` every 0.2499 s") ==
          0);
    plan.period = 0.24999;
    Diagnostics diagnostics;
    CHECK(lab::replay(plan, r, {}, diagnostics));
    plan.intervals = 6;
    plan.tables[0].weights.assign(7, 1.0);
    CHECK(refusal(plan, r).find(":7:1: error: 6 samples in the recording") == 0);
    plan = test::conductance();
    plan.inputs[0].column = "current";
    CHECK(refusal(plan, r).find(":1:1: error: there is no column 'current' for the signal `y`") == 0);
}

TEST_CASE("the first estimate comes after the window, the instants of S(t) and the priming sample") {
    CHECK(test::conductance().samples_to_first_estimate() == 3);
    CHECK(test::line(Solve::robust, 3).samples_to_first_estimate() == 4);
    CHECK(test::slope().samples_to_first_estimate() == 3);
}
