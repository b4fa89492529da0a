// SPDX-License-Identifier: GPL-3.0-or-later
// What kernels take differences of, against closed forms.
#include <catch2/catch.hpp>
#include <cmath>

#include "generator/single_precision.hpp"

namespace algest {

TEST_CASE("kernels of derivatives cancel like Legendre's polynomials") {
    // Row 1 of order d has the shifted Legendre polynomial P_d as its kernel: moment d is (d!)^2/(2d+1)!, the integrals of |P_d| over [0,1] are
    // 1, 1/2, 2/(3 sqrt 3) and 13/40. The midpoint rule over 256 nodes
    // is off by less than 1/(24 256^2) max|K''| (120 at most), and by |K'| / (4 256^2) at each change of sign: together less than a thousandth.
    const auto of = [](const kernel::Coefficients& k) { return cln::double_approx(generator::cancellation(k)); };
    CHECK(of({1}) == Approx(1.0).epsilon(1e-3));
    CHECK(of({-1, 2}) == Approx(3.0).epsilon(1e-3));
    CHECK(of({1, -6, 6}) == Approx(60.0 / (3.0 * std::sqrt(3.0))).epsilon(1e-3));
    CHECK(of({-1, 12, -30, 20}) == Approx(13.0 / 40.0 * 140.0).epsilon(1e-3));
    CHECK(of({-5, 60, -150, 100}) == of({-1, 12, -30, 20}));   // no matter of size
    CHECK(of({0, 0}) == 0.0);
}

}  // namespace algest
