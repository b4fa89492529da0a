// SPDX-License-Identifier: GPL-3.0-or-later
// The low-pass of 000, equation (43): its discretisation against the differential equation, solved by an ODE library.
#include "generator/low_pass.hpp"

#include <catch2/catch.hpp>

#include <random>
#include <utility>

#include "tests/plants/advance.hpp"

using namespace algest;
using exact::Rational;
using plants::advance;

namespace {

double number(const Rational& x) { return exact::nearest(x, plan::Scalar::float64); }

}  // namespace

TEST_CASE("the discrete low-pass is y'' + 2 zeta omega_n y' + omega_n^2 y = omega_n^2 u with u straight between samples") {
    const double period = 1e-2;
    for (const auto& [omega_n, zeta] : {std::pair{Rational(15), Rational(707) / 1000}, {Rational(15), Rational(1)}, {Rational(90), Rational(1) / 5}, {Rational(40), Rational(5)}}) {
        const low_pass::Discrete filter = low_pass::discretised(omega_n / 100, zeta);
        const double w = number(omega_n), z = number(zeta);
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> level(-1.0, 1.0);
        std::array<double, 2> state{0.3, -0.7};    // y, y'/omega_n
        std::array<double, 2> discrete = state;
        double before = level(random);
        for (int k = 0; k < 60; ++k) {
            const double now = level(random);
            advance(state, 0.0, period, [&](const auto& x, auto& dxdt, double t) {
                const double u = before + (now - before) * t / period;
                dxdt[0] = w * x[1];
                dxdt[1] = w * (u - x[0]) - 2.0 * z * w * x[1];
            });
            const auto& m = filter.transition;
            discrete = {number(m[0]) * discrete[0] + number(m[1]) * discrete[1] + number(filter.before[0]) * before + number(filter.now[0]) * now,
                        number(m[2]) * discrete[0] + number(m[3]) * discrete[1] + number(filter.before[1]) * before + number(filter.now[1]) * now};
            before = now;
            CHECK(discrete[0] == Approx(state[0]).margin(1e-9));   // what the ODE library is asked for
            CHECK(discrete[1] == Approx(state[1]).margin(1e-9));
        }
    }
}

TEST_CASE("the discrete low-pass has gain 1, to more digits than a double has") {
    const low_pass::Discrete filter = low_pass::discretised(Rational(3) / 2000, Rational(707) / 1000);
    const Rational small = exact::power(Rational(2), -150);
    CHECK(cln::abs(filter.transition[0] + filter.before[0] + filter.now[0] - 1) < small);
    CHECK(cln::abs(filter.transition[2] + filter.before[1] + filter.now[1]) < small);
}
