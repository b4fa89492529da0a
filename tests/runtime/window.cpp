// SPDX-License-Identifier: GPL-3.0-or-later
// The mirrored ring: each window contiguous, oldest sample first, whatever the ring's length and however often it went around.
#include "algest/window.hpp"

#include <catch2/catch.hpp>

#include <vector>

TEST_CASE("a window holds the newest samples of each signal, oldest first") {
    for (const int samples : {1, 2, 3, 7, 16}) {
        for (const int spare : {0, 1, 8}) {
            const int length = samples + spare;
            constexpr int signals = 3;
            std::vector<double> rings(static_cast<std::size_t>(algest::ring_scalars(signals, length)), -1.0);
            int head = 0;
            for (int k = 0; k < 5 * length + 3; ++k) {
                const double sample[signals] = {k + 0.25, k + 0.5, k + 0.75};
                algest::write_sample(rings.data(), signals, length, head, sample);
                head = head + 1 == length ? 0 : head + 1;
                if (k + 1 < samples) continue;
                const algest::WindowPosition at = algest::newest(samples, length, head);
                REQUIRE(at.start >= 0);
                REQUIRE(at.start < length);
                for (int i = 0; i < signals; ++i) {
                    const double* window = algest::window(rings.data(), i, at);
                    REQUIRE(window >= rings.data());
                    REQUIRE(window + samples <= rings.data() + rings.size());
                    for (int m = 0; m < samples; ++m) REQUIRE(window[m] == k - (samples - 1) + m + 0.25 * (i + 1));
                }
            }
        }
    }
}

TEST_CASE("a window stays as it was while the spare samples are written") {
    constexpr int samples = 5, spare = 8, length = samples + spare;
    std::vector<double> rings(static_cast<std::size_t>(algest::ring_scalars(1, length)));
    for (int first = 0; first < 2 * length; ++first) {
        int head = 0;
        double next = 0.0;
        const auto write = [&] {
            algest::write_sample(rings.data(), 1, length, head, &next);
            head = head + 1 == length ? 0 : head + 1;
            next += 1.0;
        };
        for (int k = 0; k < samples + first; ++k) write();
        const double* window = algest::window(rings.data(), 0, algest::newest(samples, length, head));
        const std::vector<double> before(window, window + samples);
        for (int k = 0; k < spare; ++k) {
            write();
            REQUIRE(std::vector<double>(window, window + samples) == before);
        }
        write();
        REQUIRE(std::vector<double>(window, window + samples) != before);  // one more is one too many
    }
}
