// SPDX-License-Identifier: GPL-3.0-or-later
// The effort of a search: a candidate that comes to the end of its share is remembered, and the selection says so.
#include "lab/selection.hpp"
#include "tests/lab/workplace.hpp"

using namespace algest;

TEST_CASE("a candidate that came to the end of its share of the effort cuts the search short, and leaves the others theirs") {
    const test::Workplace place([](std::size_t, double) { return 0.0; });
    place.bench->begin_search();
    const auto said = [&] { return lab::select_effects(*place.bench, *place.nominal, {}, {}).cut_short; };
    lab::Effort& effort = *place.nominal->bench.options.effort;
    const auto candidate = [&](double operations) {
        const lab::Workbench::OneOfMany share(*place.bench);
        effort.spent += operations;
        return place.bench->used_up();
    };
    CHECK_FALSE(candidate(1e8));
    CHECK_FALSE(said());
    CHECK(candidate(2e9));   // its share: 0.15 of 1e10
    CHECK_FALSE(place.bench->used_up());
    CHECK(said());
    place.bench->begin_search();
    CHECK_FALSE(said());
}
