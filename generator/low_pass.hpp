// SPDX-License-Identifier: GPL-3.0-or-later
// The second-order low-pass of 000, equation (43), F(s) = omega_n^2/(s^2 + 2 zeta omega_n s + omega_n^2) (its print lacks the s of the
// middle term), discretised exactly for an input that goes straight from one sample to the next.
#pragma once
#include <array>

#include "generator/exact.hpp"

namespace algest::low_pass {

/// x_(k+1) = transition x_k + before u_k + now u_(k+1), x = (y, y'/omega_n), to more digits than a double has.
struct Discrete {
    std::array<exact::Rational, 4> transition;   ///< row by row
    std::array<exact::Rational, 2> before;
    std::array<exact::Rational, 2> now;
};

/// step = omega_n times the period, 0 < step <= 1; zeta in (0, 10]. Cost: some 40 products of 4 x 4 matrices of rationals.
Discrete discretised(const exact::Rational& step, const exact::Rational& zeta);

}  // namespace algest::low_pass
