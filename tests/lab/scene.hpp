// SPDX-License-Identifier: GPL-3.0-or-later
// A model beside a recording that a test makes up, run from the model's initial values.
#pragma once
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lab/simulate.hpp"
#include "tests/lab/temporary_file.hpp"

namespace algest::test {

struct Scene {
    explicit Scene(const std::string& model_text) {
        auto read = model::read(folder.write("model.toml", model_text), false, diagnostics);
        for (const auto& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
        REQUIRE(read);
        model = *read;
    }

    /// `inputs`: name and value at an instant.
    lab::Recording recorded(std::size_t samples, const std::vector<std::pair<std::string, std::function<double(double)>>>& inputs) {
        const double period = exact::nearest(*model.period, plan::Scalar::float64);
        std::string csv = "t [s]";
        for (const auto& [name, value] : inputs) csv += "," + name + " [" + model.signal(name)->unit + "]";
        csv += "\n";
        for (std::size_t k = 0; k < samples; ++k) {
            const double t = static_cast<double>(k) * period;
            csv += fmt::format("{}", t);
            for (const auto& [name, value] : inputs) csv += fmt::format(",{}", value(t));
            csv += "\n";
        }
        const auto recording = lab::read_recording(folder.write("recording.csv", csv), diagnostics);
        REQUIRE(recording);
        return *recording;
    }

    lab::FreeRun run(std::size_t samples, const std::vector<std::pair<std::string, std::function<double(double)>>>& inputs) {
        const lab::Recording recording = recorded(samples, inputs);
        const auto bench = lab::bench(model, recording, diagnostics);
        for (const auto& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
        REQUIRE(bench);
        const auto parameters = lab::parameter_values(model, {}, diagnostics);
        REQUIRE(parameters);
        return lab::free_run(bench->system, *parameters, bench->initial, bench->drive, bench->options);
    }

    /// What is said where the model cannot be run: line, column and words of the first error.
    Diagnostic refusal() {
        Diagnostics said;
        REQUIRE_FALSE(lab::ode_system(model, said));
        return said.sorted().front();
    }

    const std::vector<double>& of(const lab::FreeRun& run, const std::string& name) const { return run.signals[static_cast<std::size_t>(model.signal_index(name))]; }

    TemporaryFolder folder;
    Diagnostics diagnostics;
    model::Model model;
};

}  // namespace algest::test
