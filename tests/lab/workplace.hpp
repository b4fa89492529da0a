// SPDX-License-Identifier: GPL-3.0-or-later
// A first-order machine, recorded here by its exact solution, and the workbench of a search on that recording.
#pragma once
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>

#include "lab/variant.hpp"
#include "tests/lab/temporary_file.hpp"

namespace algest::test {

/// x' = 3 u - 2 x + d, with u in steps of 0.2 s and d held for a period of 10 ms like u: exact from sample to sample.
struct Workplace {
    static constexpr double period = 0.01, a = 2, b = 3;
    static constexpr std::size_t samples = 4000;

    /// d: of the row and of x there; sensor: standard deviation of the noise of x; declared: the line of x in the model file.
    explicit Workplace(const std::function<double(std::size_t, double)>& d, double sensor = 1e-3, const std::string& declared = "noise = 1e-3, initial = 0",
                       const std::function<double(double)>& reading = [](double x) { return x; }, unsigned seed = 3) {
        std::mt19937 random(seed);
        std::normal_distribution<double> noise;
        std::string csv = "t [s],u [V],x [m]\n";
        double u = 0, x = 0;
        const double decay = std::exp(-a * period);
        for (std::size_t row = 0; row < samples; ++row) {
            if (row % 20 == 0) u = 2 * static_cast<double>(random()) / 4294967295.0 - 1;
            csv += fmt::format("{:.2f},{:.17g},{:.17g}\n", period * static_cast<double>(row), u, reading(x + sensor * noise(random)));
            x = decay * x + (1 - decay) / a * (b * u + d(row, x));
        }
        recording = *lab::read_recording(folder.write("run.csv", csv), said);
        bench = std::make_unique<lab::Workbench>("m.toml", recording, *lab::parts_of(recording, {}, {}, said));
        const std::string text = "name = \"m\"\n[sampling]\nperiod = \"0.01\"\n[signals]\nu = { unit = \"V\", hold = \"zoh\" }\nx = { unit = \"m\", " + declared +
                                 " }\n[parameters]\na = { unit = \"1/s\", initial = 2 }\nb = { unit = \"m/(V.s)\", initial = 3 }\n[[equation]]\node = \"der(x) = b*u - a*x\"\n";
        auto ready = bench->prepare(text, {}, said);
        for (const auto& diagnostic : said.sorted()) UNSCOPED_INFO(diagnostic.text());
        REQUIRE(ready);
        nominal = std::make_unique<lab::Variant>(std::move(*ready));
        nominal->fit = {{a, b}, {0.01, 0.01}, nominal->bench.initial, 0, true, 0};   // what a fit of the bare machine would find
    }

    TemporaryFolder folder;
    Diagnostics said;
    lab::Recording recording;
    std::unique_ptr<lab::Workbench> bench;
    std::unique_ptr<lab::Variant> nominal;
};

}  // namespace algest::test
