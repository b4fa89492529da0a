// SPDX-License-Identifier: GPL-3.0-or-later
// Over 100 runs of the noisy PMSM no ok estimate is off by more than 20 percent, and at least 95 percent of the samples after both windows fill
// are ok (issue 4, must-show 2).
#include "tests/plants/singular_instants.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("PMSM with noise, 100 runs: no ok estimate is a spike") {
    const auto [robust, plain, usual, limited] = spikes(100, 2);
    CHECK(robust.worst < 0.2);
    CHECK(robust.share() >= 0.95);
    CHECK(plain.worst >= 1.0);
    CHECK(usual.worst < 1.0);     // no spike
    CHECK(limited.worst < 0.3);   // six standard deviations of the limit, over 200000 estimates
}
