// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/simulate_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace algest::lab {

namespace {

DataList parameters_data(const Simulation& simulation) {
    DataList list;
    for (std::size_t p = 0; p < simulation.parameters.size(); ++p) {
        const model::Parameter& parameter = simulation.model.parameters[p];
        Data data;
        set_text(data, "parameter", parameter.name);
        set_text(data, "unit", unit_text(parameter.unit));
        set_quantity(data, "", simulation.parameters[p], 0);
        data.set("given", simulation.given.count(parameter.name) > 0);
        list.push_back(data);
    }
    return list;
}

/// What becomes of each signal in a free run.
DataList signals_data(const Simulation& simulation) {
    const OdeSystem& system = simulation.bench.system;
    DataList list;
    for (std::size_t s = 0; s < simulation.model.signals.size(); ++s) {
        const auto among = [&](const std::vector<int>& signals) { return std::find(signals.begin(), signals.end(), static_cast<int>(s)) != signals.end(); };
        const bool by_law = std::any_of(system.laws.begin(), system.laws.end(), [&](const Law& law) { return law.signal == static_cast<int>(s); });
        const std::string part = moves(system, s)                      ? "integrated"
                                 : by_law                              ? "set by its control law"
                                 : among(simulated_signals(system))    ? "computed"
                                 : among(system.driven)                ? (simulation.bench.drive.held[s] ? "replayed, held between samples" : "replayed, linear between samples")
                                                                       : "not used";
        Data data = entry("signal", simulation.model.signals[s].name);
        set_text(data, "unit", unit_text(simulation.model.signals[s].unit));
        set_text(data, "part", part);
        list.push_back(data);
    }
    return list;
}

}  // namespace

std::string simulate_report(const Simulation& simulation, const PageFrame& frame, const Draw& draw, Diagnostics& diagnostics) {
    Figures figures(draw, diagnostics);
    Data page;
    set_frame(page, frame, simulation.model.name, simulation.model.summary, simulation.model.source);
    set_text(page, "samples", std::to_string(simulation.recording.samples()));
    set_text(page, "period", fmt::format("{:.6g}", simulation.recording.period));
    page.set("ended", simulation.run.samples < simulation.recording.samples());
    set_text(page, "ended_s", fmt::format("{:.6g}", simulation.recording.t[simulation.run.samples - 1]));
    set_list(page, "parameters", parameters_data(simulation));
    set_list(page, "signals", signals_data(simulation));
    page.set("outputs_section", outputs_html(simulation.model, simulation.recording, simulation.bench, simulation.run, figures));
    page.set("model_section", model_html(simulation.model));
    figures.set_complaints(page);
    return generator::render("report/simulate.html.mustache", page);
}

}  // namespace algest::lab
