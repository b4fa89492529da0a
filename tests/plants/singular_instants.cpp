// SPDX-License-Identifier: GPL-3.0-or-later
// No unflagged spike: a few runs of singular_instants_long.cpp.
#include "tests/plants/singular_instants.hpp"

using namespace algest;
using namespace algest::plants;

TEST_CASE("PMSM with noise: no ok estimate of S(t) is a spike, those of the square solve without a test are") {
    const auto [robust, plain, usual, limited] = spikes(6, 5);
    CHECK(robust.worst < 0.2);      // issue 4, must-show 2
    CHECK(robust.share() >= 0.95);
    CHECK(plain.worst >= 1.0);
    CHECK(usual.worst < 0.5);       // five standard deviations of the limit
    CHECK(usual.share() > 0.9);
    CHECK(limited.worst < 0.2);     // four standard deviations of the limit
    CHECK(limited.share() > 0.7);   // the speed's 5 Hz leave the rows of one instant nearly singular ten times a second
}
