// SPDX-License-Identifier: GPL-3.0-or-later
// The derivation of 004 against its closed forms and against definitions written out here, for n <= 6, all exact.
#include "generator/discrete.hpp"

#include <catch2/catch.hpp>

namespace algest {

namespace {

using discrete::Taps;
using exact::Integer;
using exact::Rational;

Integer choose(int n, int k) { return k < 0 || k > n ? Integer(0) : cln::binomial(static_cast<unsigned>(n), static_cast<unsigned>(k)); }

/// chi(k) of 004, equation (3).
Integer chi(int k, int n, int derivatives) {
    Integer out = 1;
    for (int s = 0; s < derivatives; ++s) out = out * (k - n + s);
    return out;
}

/// The factor that `derivatives` derivatives give to one term y_kappa z^-kappa of z^i y_z; it belongs to the equation k = kappa+n-i.
Integer falling(int power, int derivatives) {
    Integer out = 1;
    for (int s = 0; s < derivatives; ++s) out = out * (power - s);
    return out;
}

/// 004, equation (8), as printed.
Rational closed_denominator(int s, int i, int n, const Rational& omega0) {
    Rational sum = 0;
    for (int j = 0; j <= s; ++j) sum = sum + ((s + j) % 2 == 0 ? 1 : -1) * Rational(choose(i, s - j) * choose(n - i, j));
    return exact::power(-omega0, i) * sum;
}
Rational closed_numerator(int s, int i, int n, int m, const Rational& omega0) {
    Rational sum = 0;
    for (int j = 0; j <= s; ++j) sum = sum + ((s + j) % 2 == 0 ? 1 : -1) * Rational(choose(i, s - j) * choose(m - i, j));
    return exact::power(Rational(2), n - m) * exact::power(-omega0, i) * sum;
}

/// `times` times the sum over all earlier instants (004, section II).
std::vector<Rational> summed(std::vector<Rational> values, int times, const Rational& gamma) {
    for (int l = 0; l < times; ++l) {
        Rational sum = 0;
        for (Rational& v : values) {
            const Rational next = gamma * sum + v;
            v = sum;
            sum = next;
        }
    }
    return values;
}

}  // namespace

TEST_CASE("discrete: Leibniz leaves one factor chi(k) at every sample, (3), and it is that of the definition") {
    for (int n = 1; n <= 6; ++n) {
        for (int derivatives = 1; derivatives <= n + 3; ++derivatives) {
            const Integer sign = derivatives % 2 == 0 ? 1 : -1;
            for (int i = 0; i <= n; ++i) {
                const std::vector<Integer> found = discrete::multiplier(i, n, derivatives);
                for (int k = -3; k <= n + 5; ++k) {
                    INFO("n = " << n << ", derivatives = " << derivatives << ", i = " << i << ", k = " << k);
                    REQUIRE(discrete::value_at(found, k) == chi(k, n, derivatives));
                    REQUIRE(sign * discrete::value_at(found, k) == falling(n - k, derivatives));
                }
            }
        }
    }
}

TEST_CASE("discrete: n+1 derivatives annihilate what was before the first sample, n do not") {
    for (int n = 1; n <= 6; ++n) {
        for (int k = 0; k < n; ++k) {
            CHECK(discrete::value_at(discrete::multiplier(n, n, n + 1), k) == 0);
            CHECK(discrete::value_at(discrete::multiplier(n, n, n + 2), k) == 0);
        }
        CHECK(discrete::value_at(discrete::multiplier(n, n, n + 1), n) == 0);   // errata.md: k = 0 .. n
        CHECK(discrete::value_at(discrete::multiplier(n, n, n + 1), n + 1) != 0);
        CHECK(discrete::value_at(discrete::multiplier(n, n, n), 0) != 0);
    }
}

TEST_CASE("discrete: the expansion of z = (1+q/Omega0)/(1-q/Omega0) gives the closed forms (8)") {
    const Rational omega0 = Rational(2000) / 7;
    for (int n = 1; n <= 6; ++n) {
        for (int i = 0; i <= n; ++i) {
            const Taps found = discrete::denominator_in_q(i, n, omega0);
            REQUIRE(found.size() == static_cast<std::size_t>(n) + 1);
            for (int s = 0; s <= n; ++s) CHECK(found[static_cast<std::size_t>(s)] == closed_denominator(s, i, n, omega0));
        }
        for (int m = 0; m <= n; ++m) {
            for (int i = 0; i <= m; ++i) {
                const Taps found = discrete::numerator_in_q(i, n, m, omega0);
                REQUIRE(found.size() == static_cast<std::size_t>(n) + 1);
                for (int s = 0; s <= n; ++s) CHECK(found[static_cast<std::size_t>(s)] == (s > m ? Rational(0) : closed_numerator(s, i, n, m, omega0)));
            }
        }
    }
}

TEST_CASE("discrete: preset zeros of z lie at -1 (section IV)") {
    const Taps found = discrete::numerator_in_z(1, 5, 4, 2);   // (z+1)^2 z
    CHECK(found == Taps{0, 1, 2, 1, 0, 0});
}

TEST_CASE("discrete: levels are iterated sums, or iterated filters 1/(z-gamma)") {
    constexpr int count = 12;
    for (const Rational& gamma : {Rational(1), Rational(9) / 10, Rational(1) / 2}) {
        for (int l = 0; l <= 5; ++l) {
            std::vector<Rational> impulse(count, 0);
            impulse[0] = 1;
            const std::vector<Rational> wanted = summed(impulse, l, gamma);
            const std::vector<Integer> found = discrete::level(l, gamma, count);
            REQUIRE(found.size() == count);
            const Rational unit = Rational(found[static_cast<std::size_t>(l)]);
            CHECK(unit > 0);
            for (std::size_t d = 0; d < count; ++d) CHECK(found[d] / unit == wanted[d]);
        }
    }
}

TEST_CASE("discrete: weights are what section II sums, without the newest l samples") {
    constexpr int n = 3, derivatives = 4, intervals = 14;
    const std::vector<Integer> f = {3, -1, 4, 1, -5, 9, 2, -6, 5, 3, -5, 8, 9, -7, 9};
    const std::vector<Integer> taps = {2, -3, 5, 7};
    const std::vector<Integer> chi_polynomial = discrete::multiplier(0, n, derivatives);
    for (int l = 0; l <= 6; ++l) {
        std::vector<Rational> first;   // chi(k) sum_s taps f(k-n+s)
        for (int k = 0; k <= intervals; ++k) {
            Rational sum = 0;
            for (int s = 0; s <= n; ++s) {
                if (k - n + s >= 0) sum = sum + taps[static_cast<std::size_t>(s)] * f[static_cast<std::size_t>(k - n + s)];
            }
            first.push_back(chi(k, n, derivatives) * sum);
        }
        const Rational wanted = summed(first, l, 1).back();
        const std::vector<Integer> w = discrete::weights(chi_polynomial, discrete::level(l, 1, intervals + 1), taps, intervals);
        Integer sum = 0;
        for (std::size_t k = 0; k < f.size(); ++k) sum = sum + w[k] * f[k];
        CHECK(sum == wanted);
        for (int k = intervals - l + 1; k <= intervals; ++k) CHECK(w[static_cast<std::size_t>(k)] == 0);
        CHECK(w[static_cast<std::size_t>(intervals - l)] != 0);
    }
}

TEST_CASE("discrete: the impulse response of a filter") {
    // (1 + z^-1)/(2 - z^-1): h_0 = 1/2, h_d = 3/4 (1/2)^(d-1)
    const std::vector<Integer> h = discrete::impulse_response({1, 1}, {2, -1}, 5);
    CHECK(h == std::vector<Integer>{16, 24, 12, 6, 3});
    CHECK(discrete::convolved({1, 2, 3, 4}, {1, 0, 2}) == std::vector<Integer>{1, 2, 5, 8});
}

}  // namespace algest
