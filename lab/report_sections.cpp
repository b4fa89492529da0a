// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/report_sections.hpp"

#include <algorithm>

#include "lab/figure_parts.hpp"
#include "lab/html_text.hpp"
#include "lab/mathml.hpp"
#include "lab/noise.hpp"
#include "lab/output_figure.hpp"
#include "lab/quantity.hpp"

namespace algest::lab {

namespace {

Data output_data(const model::Signal& signal, const OutputError* error, double noise) {
    Data data;
    set_text(data, "signal", signal.name);
    set_text(data, "unit", unit_text(signal.unit));
    data.set("compared", error != nullptr);
    set_text(data, "rmse", error != nullptr ? three_digits(error->rmse) : "");
    set_text(data, "nrmse", error != nullptr ? three_digits(error->nrmse) : "");
    set_text(data, "noise", noise > 0 ? three_digits(noise) : "-");
    data.set("has_noise", noise > 0);
    return data;
}

/// One line of an align*: left &= right.
std::string line_of(const std::string& left, const std::string& right) { return left + " &= " + right + " \\\\\n"; }

std::string formulas_html(const std::string& lines) { return lines.empty() ? "" : "<div class=\"formula\">" + mathml(lines, true) + "</div>\n"; }

}  // namespace

std::string outputs_html(const model::Model& model, const Recording& recording, const Bench& bench, const FreeRun& run, Figures& figures) {
    const std::vector<OutputError> errors = output_errors(model, bench, run, 0, run.samples);
    const std::vector<double> noises = noise_by_signal(model, bench);
    DataList list;
    bool any_noise = false;
    bool any_compared = false;
    for (const int s : simulated_signals(bench.system)) {
        const auto index = static_cast<std::size_t>(s);
        const model::Signal& signal = model.signals[index];
        const auto error = std::find_if(errors.begin(), errors.end(), [&](const OutputError& e) { return e.signal == s; });
        const double noise = declares_noise(signal) ? noises[index] : 0;
        Data data = output_data(signal, error == errors.end() ? nullptr : &*error, noise);
        any_noise = any_noise || noise > 0;
        any_compared = any_compared || error != errors.end();
        std::vector<double> simulated;
        for (std::size_t row = 0; row < recording.samples(); ++row) simulated.push_back(run_value(run, index, row));
        const auto figure = output_figure(signal, recording.t, bench.measured[index], {{"simulated", colour::after, std::move(simulated)}}, noise, "free run");
        if (!figure) continue;
        data.set("measured", !bench.measured[index].empty());
        data.set("detail", figure->detail);
        data.set("diverges", figure->diverges[0]);
        figures.set(data, figure->figure);
        list.push_back(data);
    }
    Data section;
    set_list(section, "outputs", std::move(list));
    section.set("has_errors", any_compared);
    section.set("any_noise", any_noise);
    return generator::render("report/outputs.html.mustache", section);
}

std::string model_html(const model::Model& model) {
    std::string out;
    for (const model::Equation& e : model.equations) {
        out += "<h4>" + html_text(e.name) + "</h4>\n";
        out += formulas_html(line_of(formula::latex(e.sides.left), formula::latex(e.sides.right)));
    }
    std::string computed;
    for (const model::Signal& s : model.signals) if (s.formula) computed += line_of(formula::latex_name(s.name), formula::latex(s.formula));
    if (!computed.empty()) out += "<h4>Computed signals</h4>\n" + formulas_html(computed);
    std::string laws;
    for (const model::Feedback& f : model.feedback) laws += line_of(formula::latex_name(f.signal), formula::latex(f.law));
    if (!laws.empty()) out += "<h4>Control laws, sampled once a period and held</h4>\n" + formulas_html(laws);
    return out;
}

void set_frame(Data& page, const PageFrame& frame, const std::string& name, const std::string& summary, const std::string& source) {
    set_style(page);
    set_text(page, "model_name", name);
    set_text(page, "model_summary", summary);
    page.set("has_model_summary", !summary.empty());
    set_text(page, "model_source", source);
    page.set("has_model_source", !source.empty());
    set_text(page, "model_file", frame.model_file);
    set_text(page, "recording_file", frame.recording_file);
    set_text(page, "command", "algest " + shell_words(frame.command));
}

}  // namespace algest::lab
