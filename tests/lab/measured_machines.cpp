// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of real machines with what no term can say: a sensor that loses the sign, an input that comes late.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "lab/fit.hpp"
#include "tests/lab/temporary_file.hpp"

using namespace algest;

namespace {

struct Machine {
    model::Model model;
    lab::Bench bench;
    lab::Fit fit;
    double missed;   ///< nrmse of the rows behind those that were fitted

    double operator[](const char* name) const { return fit.parameters[static_cast<std::size_t>(model.parameter_index(name))]; }
};

/// The model fitted to the first 70 percent; nullopt, and a warning, where there are no recordings.
std::optional<Machine> fitted(const char* file, const std::string& text) {
    const std::string path = std::string(ALGEST_SHARED "/recordings/") + file;
    if (!std::filesystem::exists(path)) {
        WARN("skipped: there is no " << path);
        return std::nullopt;
    }
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    const auto model = model::read(folder.write("m.toml", text), false, diagnostics);
    const auto recording = lab::read_recording(path, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(model);
    REQUIRE(recording);
    const auto bench = lab::bench(*model, *recording, diagnostics);
    REQUIRE(bench);
    const std::size_t end = recording->samples() * 7 / 10;
    Machine out{*model, *bench, {}, 0};
    out.fit = lab::fit(*model, *bench, {*lab::parameter_values(*model, {}, diagnostics), {}, bench->initial, {0, end}, 60});
    // One run over everything, scored behind the fitted rows.
    const auto run = lab::prediction(*bench, out.fit.parameters, out.fit.initial, {0, recording->samples()});
    const std::size_t s = static_cast<std::size_t>(lab::scored_outputs(*model, *bench)[0]);
    double squares = 0;
    for (std::size_t row = end; row < recording->samples(); ++row) squares += std::pow(bench->measured[s][row] - run[s][row], 2);
    out.missed = std::sqrt(squares / static_cast<double>(recording->samples() - end)) / lab::size_of(bench->measured[s]);
    return out;
}

/// Two motors on a belt, a speed sensor `sensor`.
std::string drives(const std::string& sensor) {
    return R"toml(name = "drives"
[sampling]
period = 0.02
[signals]
u = { unit = "V", hold = "zoh" }
y = { column = "y_speed" }
m = { initial = 0, max = 5 }
w = { initial = 0, max = 5 }
[parameters]
a = { unit = "1/s", initial = 5, min = 0 }
b = { initial = 2.5 }
wn2 = { unit = "1/s^2", initial = 350, min = 0 }
d = { unit = "1/s", initial = 5, min = 0 }
[[equation]]
ode = "der(m) = a*(b*u - m)"
[[equation]]
ode = "der(w,2) = wn2*(m - w) - d*der(w)"
[[equation]]
ode = ")toml" + sensor + "\"\n";
}

std::string dryer(const std::string& input) {
    return R"toml(name = "dryer"
[sampling]
period = 0.08
[signals]
u = { unit = "V", column = "u_heater", hold = "zoh" }
y = { unit = "V", column = "y_air_temperature_sensor" }
[parameters]
a1 = { unit = "1/s", initial = 8, min = 0 }
a0 = { unit = "1/s^2", initial = 15, min = 0 }
b0 = { unit = "1/s^2", initial = 12 }
c0 = { unit = "V/s^2", initial = 10 }
tau = { unit = "s", initial = 0.05, min = 0 }
[[equation]]
ode = "der(y,2) = b0*)toml" + input + R"toml( + c0 - a0*y - a1*der(y)"
)toml";
}

}  // namespace

TEST_CASE("two motors on a belt: with the sensor's absolute value the belt and the motors are what is published") {
    const auto machine = fitted("coupled_drives.csv", drives("y = abs(w)"));
    const auto without = fitted("coupled_drives.csv", drives("y = w"));
    if (!machine) return;
    const double frequency = std::sqrt((*machine)["wn2"]);
    const double damping = (*machine)["d"] / (2 * frequency);
    fmt::print("coupled drives: {:.2f} rad/s, damping {:.3f}, pole {:.2f} 1/s; nrmse behind the fitted rows {:.3f}, with a sensor that keeps the sign {:.3f}\n", frequency, damping, (*machine)["a"], machine->missed, without->missed);
    CHECK(frequency == Approx(20).epsilon(0.05));    // Wigren and Schoukens: about 20 rad/s,
    CHECK((damping > 0.12 && damping < 0.16));       // 0.12 to 0.16,
    CHECK((*machine)["a"] == Approx(6).epsilon(0.1));   // near 6 /s
    CHECK(machine->missed < 0.4 * without->missed);
}

TEST_CASE("a hair dryer: its heat comes about two samples late") {
    const auto machine = fitted("hair_dryer.csv", dryer("delay(u, tau)"));
    const auto without = fitted("hair_dryer.csv", dryer("u"));
    if (!machine) return;
    fmt::print("hair dryer: {:.3f} s late; nrmse behind the fitted rows {:.4f}, without a delay {:.4f}\n", (*machine)["tau"], machine->missed, without->missed);
    CHECK((*machine)["tau"] == Approx(0.16).margin(0.08));   // "about 2 samples" of 0.08 s
    CHECK(machine->missed < without->missed);
}
