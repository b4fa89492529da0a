// SPDX-License-Identifier: GPL-3.0-or-later
// The parabola filter against the appendix of Tebaldi, Morselli, Zanasi (001), which is written for any spacing, and on the
// signal (9) of that paper.
#include "algest/parabola_filter.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace {

struct Filtered {
    std::vector<double> value, derivative;
};

/// function [dz,zf]=DX_DT(t,z), appendix A, but for its last value: any increasing t. In long double: b and c are differences
/// of large numbers.
Filtered dx_dt(const std::vector<long double>& t, const std::vector<double>& z) {
    std::vector<long double> dz(z.size()), zf(z.size());
    dz[0] = (static_cast<long double>(z[1]) - z[0]) / (t[1] - t[0]);
    zf[0] = z[0];
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
        const long double x0 = t[i - 1], x1 = t[i], x2 = t[i + 1];
        const long double s0 = zf[i - 1], ds0 = dz[i - 1], y1 = z[i], y2 = z[i + 1];
        const long double a = -((s0 - ds0 * x0 + ds0 * x1 - y1) * std::pow(x0 - x1, 2.0L) +
                                (s0 - ds0 * x0 + ds0 * x2 - y2) * std::pow(x0 - x2, 2.0L)) /
                              (std::pow(x0 - x1, 4.0L) + std::pow(x0 - x2, 4.0L));
        const long double b = ds0 - 2.0L * a * x0;
        const long double c = s0 - a * x0 * x0 - b * x0;
        zf[i] = a * x1 * x1 + b * x1 + c;
        dz[i] = 2.0L * a * x1 + b;
    }
    return {{zf.begin(), zf.end() - 1}, {dz.begin(), dz.end() - 1}};
}

Filtered filtered(double period, const std::vector<double>& z) {
    algest::ParabolaFilter<double> filter{};
    Filtered out;
    filter.start(z[0], z[1]);
    out.value.push_back(filter.value);
    out.derivative.push_back(filter.slope / period);
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
        filter.advance(z[i], z[i + 1]);
        out.value.push_back(filter.value);
        out.derivative.push_back(filter.slope / period);
    }
    return out;
}

constexpr std::array<double, 5> amplitude{50.0, 73.0, 33.0, 12.0, 96.0};
constexpr std::array<double, 5> frequency{22.0, 87.0, 94.0, 61.0, 46.0};

double signal(double t) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 5; ++i) sum += amplitude[i] * std::sin(2.0 * std::numbers::pi * frequency[i] * t);
    return sum;
}

double exact_derivative(double t) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 5; ++i) {
        const double w = 2.0 * std::numbers::pi * frequency[i];
        sum += amplitude[i] * w * std::cos(w * t);
    }
    return sum;
}

}  // namespace

TEST_CASE("the parabola filter is that of the paper's appendix with equal spacing") {
    std::mt19937_64 random(4);
    std::normal_distribution<double> noise(0.0, 0.3);
    for (const double period : {1.0, 1e-3, 1e-4, 0.3}) {
        std::vector<long double> t;
        std::vector<double> z;
        for (int k = 0; k < 400; ++k) {
            t.push_back(static_cast<long double>(k) * static_cast<long double>(period));
            z.push_back(2.0 + std::sin(0.05 * k) + noise(random));
        }
        const Filtered paper = dx_dt(t, z), ours = filtered(period, z);
        REQUIRE(ours.value.size() == paper.value.size());
        for (std::size_t k = 0; k < ours.value.size(); ++k) {
            // the filter's poles are inside the unit circle: roundings of about 1e-15 die out and do not add up
            REQUIRE(std::abs(ours.value[k] - paper.value[k]) < 1e-13);
            REQUIRE(std::abs(ours.derivative[k] - paper.derivative[k]) < 1e-13 / period);
        }
    }
}

TEST_CASE("the parabola filter follows a straight line and forgets what it started from") {
    std::vector<double> z;
    for (int k = 0; k < 200; ++k) z.push_back(3.0 - 0.25 * k);
    for (const double s : filtered(1.0, z).derivative) REQUIRE(s == -0.25);  // exact in binary
    z[0] = 50.0;
    const Filtered after = filtered(1.0, z);
    CHECK(after.derivative[0] == 2.75 - 50.0);
    CHECK(after.derivative.back() == Approx(-0.25).epsilon(1e-12));
}

TEST_CASE("the derivative of signal (9): a hundredth of the error of the difference quotient") {
    constexpr double period = 1e-4;
    constexpr int last = 250;  // 0.025 s
    std::vector<double> z;
    for (int k = 0; k <= last; ++k) z.push_back(signal(k * period));
    const Filtered ours = filtered(period, z);
    double our_error = 0.0, quotient_error = 0.0;
    for (std::size_t k = 1; k + 1 < z.size(); ++k) {  // interior samples
        const double wanted = exact_derivative(static_cast<double>(k) * period);
        our_error += std::abs(ours.derivative[k] - wanted);
        quotient_error += std::abs((z[k] - z[k - 1]) / period - wanted);
    }
    const double ratio = our_error / quotient_error;
    INFO("ratio " << ratio);
    CHECK(ratio > 0.0090);  // errata.md; the paper prints 0.0095
    CHECK(ratio < 0.0105);
}
