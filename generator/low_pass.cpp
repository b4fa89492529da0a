// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/low_pass.hpp"

namespace algest::low_pass {

namespace {

using exact::Rational;
using Matrix = std::array<std::array<Rational, 4>, 4>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            out[i][j] = 0;
            for (std::size_t k = 0; k < 4; ++k) out[i][j] = out[i][j] + a[i][k] * b[k][j];
        }
    }
    return out;
}

/// Binary places that the series keeps: more than the 53 of a double and the 33 that its largest term, 25^25/25!, cancels use up
/// together, twice over, so that the one rounding to a scalar is the only one that shows.
constexpr int places = 200;

/// Nearest multiple of 2^-places: keeps the rationals of a series short.
Rational shortened(const Rational& x) {
    const Rational scale = exact::power(Rational(2), places);
    return Rational(cln::round1(x * scale)) / scale;
}

/// exp of a matrix of norm at most 25: its Taylor series, up to terms as small as what its roundings add up to.
Matrix exponential(const Matrix& m) {
    Matrix out;
    Matrix term;
    for (std::size_t i = 0; i < 4; ++i) for (std::size_t j = 0; j < 4; ++j) out[i][j] = term[i][j] = i == j ? 1 : 0;
    const Rational small = exact::power(Rational(2), 10 - places);
    for (int k = 1;; ++k) {
        term = product(term, m);
        bool vanished = true;
        for (auto& row : term) {
            for (Rational& x : row) {
                x = shortened(x / k);
                vanished = vanished && cln::abs(x) < small;
            }
        }
        for (std::size_t i = 0; i < 4; ++i) for (std::size_t j = 0; j < 4; ++j) out[i][j] = out[i][j] + term[i][j];
        if (vanished) return out;
    }
}

}  // namespace

Discrete discretised(const Rational& step, const Rational& zeta) {
    // (y, y'/omega_n, u, u's change over the period) in units of the period: the last two are the input that goes straight.
    Matrix m;
    for (auto& row : m) row.fill(0);
    m[0][1] = step;
    m[1][0] = -step;
    m[1][1] = -2 * zeta * step;
    m[1][2] = step;
    m[2][3] = 1;
    const Matrix e = exponential(m);
    Discrete out;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 2; ++j) out.transition[2 * i + j] = e[i][j];
        out.before[i] = e[i][2] - e[i][3];
        out.now[i] = e[i][3];
    }
    return out;
}

}  // namespace algest::low_pass
