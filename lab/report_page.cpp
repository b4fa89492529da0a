// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/figure_parts.hpp"
#include "lab/html_text.hpp"
#include "lab/quantity.hpp"

namespace algest::lab {

void set_text(Data& data, const std::string& name, const std::string& text) { data.set(name, html_text(text)); }

Data entry(const std::string& name, const std::string& text) {
    Data data;
    set_text(data, name, text);
    return data;
}

void set_list(Data& data, const std::string& name, DataList list) {
    data.set("has_" + name, !list.empty());
    data.set(name, generator::listed(std::move(list)));
}

std::string unit_text(const std::string& unit) { return unit.empty() ? "unknown" : unit; }

void set_quantity(Data& data, const std::string& prefix, double value, double sd) {
    const Quantity q = quantity(value, sd);
    set_text(data, prefix + "value", q.value);
    set_text(data, prefix + "sd", q.sd);
    data.set(prefix + "has_sd", !q.sd.empty());
    data.set(prefix + "unseen", !std::isfinite(sd));
    data.set(prefix + "chosen_constant", sd == 0);
    set_text(data, prefix + "exponent", q.exponent);
    data.set(prefix + "has_exponent", !q.exponent.empty());
}

std::string shell_word(const std::string& text) {
    const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::string("/._-+=:,@%").find(c) != std::string::npos;
    });
    if (plain) return text;
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string shell_words(const std::vector<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts) out += (out.empty() ? "" : " ") + shell_word(text);
    return out;
}

void set_style(Data& page) {
    Data colours;
    colours.set("measured", std::string(colour::measured));
    colours.set("before", std::string(colour::before));
    colours.set("after", std::string(colour::after));
    colours.set("without", std::string(colour::without));
    colours.set("law", std::string(colour::law));
    page.set("style", generator::render("report/style.css.mustache", colours));
}

void Figures::set(Data& data, const Figure& figure) {
    data.set("drawn", false);
    data.set("svg", std::string());
    data.set("panels", std::to_string(figure.panels.size()));
    if (missing_) return;
    const Drawing drawing = draw_(gnuplot_script(figure));
    if (drawing.outcome == Drawing::Outcome::not_installed) {
        missing_ = true;
        diagnostics_.warning("gnuplot", {}, "is not installed: the report has no figures", "apt-get install gnuplot-nox");
    } else if (drawing.outcome == Drawing::Outcome::failed) {
        failed_ = true;
        diagnostics_.warning("gnuplot", {}, "cannot draw '" + figure.title + "': " + drawing.complaint);
    } else {
        data.set("drawn", true);
        data.set("svg", inline_svg(drawing.svg, fmt::format("figure{}_", ++count_), figure.title));
    }
}

void Figures::set_complaints(Data& page) const {
    page.set("no_gnuplot", missing_);
    page.set("figure_failed", failed_);
}

}  // namespace algest::lab
