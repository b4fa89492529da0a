// SPDX-License-Identifier: GPL-3.0-or-later
// The dot product: its order of summation is part of the contract, so it is checked to the last bit.
#include "algest/dot.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace {

/// The order as dot.hpp states it, written out: lane j of eight adds the products j, j+8, ... of the whole groups of eight; the
/// lanes are added as ((0+4)+(2+6)) + ((1+5)+(3+7)); the products left over are added one by one.
template <class S>
S stated_order(const std::vector<S>& w, const std::vector<S>& x) {
    const std::size_t grouped = w.size() / 8 * 8;
    std::array<S, 8> lane{};
    for (std::size_t j = 0; j < 8; ++j) {
        for (std::size_t k = j; k < grouped; k += 8) {
            const S product = w[k] * x[k];
            lane[j] = lane[j] + product;
        }
    }
    const S even = (lane[0] + lane[4]) + (lane[2] + lane[6]);
    const S odd = (lane[1] + lane[5]) + (lane[3] + lane[7]);
    S sum = even + odd;
    for (std::size_t k = grouped; k < w.size(); ++k) {
        const S product = w[k] * x[k];
        sum = sum + product;
    }
    return sum;
}

template <class S>
S one_by_one(const std::vector<S>& w, const std::vector<S>& x) {
    S sum = S(0);
    for (std::size_t k = 0; k < w.size(); ++k) sum += w[k] * x[k];
    return sum;
}

/// Both signs and seven decades, so that the order shows.
template <class S>
std::vector<S> numbers(std::size_t count, std::mt19937_64& random) {
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0), decade(-4.0, 3.0);
    std::vector<S> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(static_cast<S>(mantissa(random) * std::pow(10.0, decade(random))));
    return out;
}

template <class S>
void compare() {
    std::mt19937_64 random(3);
    std::vector<std::size_t> counts;
    for (std::size_t n = 0; n <= 70; ++n) counts.push_back(n);
    for (const std::size_t n : {201U, 501U, 801U, 2001U, 3001U}) counts.push_back(n);
    int order_shows = 0;
    for (const std::size_t n : counts) {
        for (int repeat = 0; repeat < 20; ++repeat) {
            const std::vector<S> w = numbers<S>(n, random), x = numbers<S>(n, random);
            const S found = algest::dot(w.data(), x.data(), static_cast<int>(n));
            const S wanted = stated_order(w, x);
            INFO("count " << n);
            REQUIRE(std::memcmp(&found, &wanted, sizeof(S)) == 0);
            order_shows += found != one_by_one(w, x) ? 1 : 0;
        }
    }
    CHECK(order_shows > 500);  // another order gives other bits: the comparison above can fail
}

}  // namespace

TEST_CASE("dot sums in the stated order, to the last bit") {
    compare<double>();
    compare<float>();
}

TEST_CASE("dot of nothing is zero, and what is not finite passes through") {
    CHECK(algest::dot<double>(nullptr, nullptr, 0) == 0.0);
    for (int n = 1; n <= 20; ++n) {
        std::vector<double> w(static_cast<std::size_t>(n), 1.0), x = w;
        for (int k = 0; k < n; ++k) {
            x.assign(static_cast<std::size_t>(n), 1.0);
            x[static_cast<std::size_t>(k)] = std::nan("");
            CHECK(std::isnan(algest::dot(w.data(), x.data(), n)));
            x[static_cast<std::size_t>(k)] = INFINITY;
            CHECK(algest::dot(w.data(), x.data(), n) == INFINITY);
        }
    }
}
