// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers by seed, the same on every machine: the standard library's distributions are not.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace algest::gap {

/// splitmix64.
class Random {
public:
    /// A stream of its own for every text and number: cases of two families never share one.
    Random(const std::string& text, std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 0xD1B54A32D192ED03ull) {
        for (const char c : text) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
        for (int i = 0; i < 8; ++i) bits();
    }

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }

    double uniform(double from, double to) { return from + (to - from) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
    double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
    int integer(int from, int to) { return from + static_cast<int>(bits() % static_cast<std::uint64_t>(to - from + 1)); }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    double sign() { return chance(0.5) ? 1.0 : -1.0; }

    /// Box and Muller, one of the two.
    double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
        return radius * std::cos(2 * M_PI * uniform(0, 1));
    }

private:
    std::uint64_t state_;
};

}  // namespace algest::gap
