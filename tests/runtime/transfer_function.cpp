// SPDX-License-Identifier: GPL-3.0-or-later
// Roots and changes of variable against polynomials made of known roots.
#include "algest/transfer_function.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

using namespace algest;
using Complex = std::complex<double>;

namespace {

std::vector<double> with_roots(const std::vector<Complex>& roots, double leading) {
    std::vector<Complex> out = {leading};
    for (const Complex r : roots) {
        out.push_back(0.0);
        for (std::size_t k = out.size() - 1; k > 0; --k) out[k] = out[k - 1] - r * out[k];
        out[0] *= -r;
    }
    std::vector<double> real;
    for (const Complex c : out) real.push_back(c.real());
    return real;
}

double distance(const std::vector<Complex>& found, Complex to) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Complex f : found) nearest = std::min(nearest, std::abs(f - to));
    return nearest;
}

std::vector<Complex> roots_of(const std::vector<double>& c) {
    std::vector<Complex> out(c.size() - 1);
    polynomial_roots(c.data(), static_cast<int>(c.size()) - 1, out.data());
    return out;
}

}  // namespace

TEST_CASE("roots: random polynomials up to degree 12") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<Complex> roots;
        const double scale = std::pow(10.0, 3.0 * uniform(random));
        for (int pair = 0; pair < trial % 6; ++pair) {
            const Complex r = scale * Complex(uniform(random), 0.2 + std::abs(uniform(random)));
            roots.push_back(r);
            roots.push_back(std::conj(r));
        }
        for (int real = 0; real < 1 + trial % 2; ++real) roots.push_back(scale * uniform(random));
        const std::vector<Complex> found = roots_of(with_roots(roots, uniform(random) + 2.0));
        REQUIRE(found.size() == roots.size());
        // The coefficients were rounded: 1e-16 times the condition of up to twelve roots in one disc.
        for (const Complex r : roots) REQUIRE(distance(found, r) < 1e-6 * scale);
    }
}

TEST_CASE("roots: none, zeros, one many times, and numbers that are none") {
    CHECK(roots_of({5.0}).empty());
    const std::vector<Complex> zeros = roots_of({0.0, 0.0, 2.0, 1.0});
    CHECK(distance(zeros, 0.0) == 0.0);
    CHECK(distance(zeros, -2.0) < 1e-14);
    for (const Complex r : roots_of(with_roots({1.0, 1.0, 1.0, 1.0}, 1.0))) CHECK(std::abs(r - 1.0) < 1e-3);   // epsilon^(1/4)
    for (const Complex r : roots_of({std::numeric_limits<double>::quiet_NaN(), 1.0, 1.0})) CHECK_FALSE(std::isfinite(std::abs(r)));
}

TEST_CASE("transfer function: from q to z and back") {
    constexpr TransferOrders orders{3, 2, 1};
    constexpr double period = 0.02;
    const std::array<double, 3> A = {0.3, 0.04, 0.002};
    const std::array<double, 2> B = {2.0, -0.1};
    std::array<double, 4> a{};
    std::array<double, 2> b{};
    z_from_q(orders, period, A.data(), B.data(), a.data(), b.data());
    REQUIRE(a[3] == 1.0);
    const double omega0 = 2.0 / period;
    for (const Complex z : {Complex(0.3, 0.9), Complex(-0.5, 0.2), Complex(2.0, -1.0)}) {   // equation (4)
        const Complex q = omega0 * (z - 1.0) / (z + 1.0);
        const Complex in_q = (1.0 - q / omega0) * (B[0] + B[1] * q) / (1.0 + A[0] * q + A[1] * q * q + A[2] * q * q * q);
        const Complex in_z = (z + 1.0) * (b[0] + b[1] * z) / (a[0] + a[1] * z + a[2] * z * z + z * z * z);
        CHECK(std::abs(in_z / in_q - 1.0) < 1e-13);
    }
    std::array<double, 3> A_back{};
    std::array<double, 2> B_back{};
    q_from_z(orders, period, a.data(), b.data(), A_back.data(), B_back.data());
    for (std::size_t i = 0; i < A.size(); ++i) CHECK(A_back[i] == Approx(A[i]).epsilon(1e-10));
    for (std::size_t i = 0; i < B.size(); ++i) CHECK(B_back[i] == Approx(B[i]).epsilon(1e-10));
}

TEST_CASE("transfer function: continuous-time poles behind a hold") {
    const Complex s(-1.5, 20.0);
    constexpr double period = 0.01;
    CHECK(std::abs(continuous_from_z(std::exp(s * period), period) - s) < 1e-12);
    CHECK(std::abs(continuous_from_q(2.0 / period * std::tanh(0.5 * s * period), period) - s) < 1e-12);
    // (1 + q/5) (1 + q/80): the pole s has q = Omega0 tanh(s/Omega0)
    std::array<Complex, 2> poles{};
    const std::array<double, 2> A = {1.0 / 5.0 + 1.0 / 80.0, 1.0 / 400.0};
    continuous_poles_of_q(A.data(), 2, period, poles.data());
    for (const double q : {-5.0, -80.0}) CHECK(distance({poles.begin(), poles.end()}, 200.0 * std::atanh(q / 200.0)) < 1e-10);
}
