// SPDX-License-Identifier: GPL-3.0-or-later
// Where a model is off, on recordings of a machine whose disturbance is known.
#include "lab/locate.hpp"

#include <catch2/catch.hpp>

#include "tests/lab/workplace.hpp"

using namespace algest;
using algest::test::Workplace;

namespace {

lab::Where where(const Workplace& w) {
    w.bench->fit_and_score(*w.nominal, {Workplace::a, Workplace::b}, w.nominal->bench.initial);
    const auto before = w.bench->run(*w.nominal, 1e-6, 0);
    const auto found = lab::locate(*w.bench, *w.nominal, lab::residuals(*w.bench, *w.nominal, nullptr), before);
    REQUIRE(found.size() == 1);
    return found.front();
}

}  // namespace

TEST_CASE("locate: nowhere, where there is noise alone") {
    CHECK(where(Workplace([](std::size_t, double) { return 0.0; })).share == 0);
}

TEST_CASE("locate: the stretch in which something pushed") {
    const lab::Where found = where(Workplace([](std::size_t row, double) { return row >= 1200 && row < 1500 ? 0.5 : 0.0; }));   // 12 s to 15 s
    CHECK(found.share == 1);
    CHECK(found.equation == "equation 1");
    CHECK(found.from_s == Approx(12).margin(1));   // the windows are some tenths of a second long, and the ends hold a tenth of the power
    CHECK(found.to_s == Approx(15).margin(1));
}

TEST_CASE("locate: the signal that the residual hangs on, and how") {
    CHECK(where(Workplace([](std::size_t, double x) { return x > 0 ? -0.3 : 0.3; })).region == "follows the sign of x");
}
