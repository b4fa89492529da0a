// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

constexpr int font = 12;                       ///< px
constexpr int small_font = 10;                 ///< px, of a label that is too long
constexpr double width_of_character = 0.61;    ///< over the size of the font: of DejaVu Sans, the widest of those in use
constexpr double pixels_per_x_number = 60;
constexpr double pixels_per_y_number = 26;
constexpr double label_line = 15;              ///< px, from the edge to the middle of an axis label

/// As a string of gnuplot in which nothing is expanded.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') out += "''";
        else out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + "'";
}

/// UTF-8 characters of a text, one by one.
std::vector<std::string> characters(const std::string& text) {
    std::vector<std::string> out;
    for (const char c : text) {
        if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U && !out.empty()) out.back() += c;
        else out.emplace_back(1, c);
    }
    return out;
}

/// At most `most` characters, the middle replaced by an ellipsis.
std::string shortened(const std::string& text, std::size_t most) {
    const auto all = characters(text);
    if (all.size() <= most) return text;
    std::string out;
    const std::size_t tail = (most - 1) / 3;
    const std::size_t head = most - 1 - tail;
    for (std::size_t k = 0; k < head; ++k) out += all[k];
    out += "\u2026";
    for (std::size_t k = all.size() - tail; k < all.size(); ++k) out += all[k];
    return out;
}

std::string power_of_ten(int exponent) {
    static const char* const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074", "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string out = "10";
    if (exponent < 0) out += "\u207b";
    for (const char c : std::to_string(std::abs(exponent))) out += digits[c - '0'];
    return out;
}

/// How an axis is numbered: by multiples of 1, 2 or 5 powers of ten.
struct Numbering {
    int exponent;    ///< the numbers stand for multiples of 10^exponent
    double scale;    ///< 10^-exponent
    double step;     ///< scaled
    int decimals;
};

Numbering numbering(const Axis& axis, double pixels, double pixels_per_number) {
    const double largest = std::max(std::abs(axis.from), std::abs(axis.to));
    const bool far = largest > 0 && (largest < 1e-2 || largest >= 1e4);
    const int exponent = far ? 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0)) : 0;
    const double scale = std::pow(10.0, -exponent);
    const double rough = (axis.to - axis.from) * scale / std::max(2.0, std::floor(pixels / pixels_per_number));
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double factor = rough / power;
    const double step = power * (factor <= 1 ? 1 : factor <= 2 ? 2 : factor <= 5 ? 5 : 10);
    return {exponent, scale, step, std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)))};
}

struct Label {
    std::string text;
    int font;
};

/// "name [unit]" in at most so many pixels: in the small font, then shortened, where it is too long.
Label label(const Axis& axis, const Numbering& n, double pixels) {
    std::string unit = axis.unit.empty() ? "unknown" : axis.unit;
    if (n.exponent != 0) unit = power_of_ten(n.exponent) + (unit == "1" ? "" : "\u00a0" + unit);
    const std::string whole = axis.name + " [" + unit + "]";
    const auto room = [&](int size) { return static_cast<std::size_t>(std::max(pixels / (width_of_character * size), 12.0)); };
    if (characters(whole).size() <= room(font)) return {whole, font};
    const std::size_t most = room(small_font);
    unit = shortened(unit, most - 7);
    return {shortened(axis.name, most - 3 - characters(unit).size()) + " [" + unit + "]", small_font};
}

class Script {
public:
    explicit Script(const Figure& figure) : figure_(figure) {}

    std::string text() {
        line("set encoding utf8");
        line("set terminal svg size {},{} dynamic noenhanced rounded font 'sans-serif,{}' background 'white'", figure_.width, figure_.height, font);
        line("set multiplot");
        line("unset key");
        line("set border 3 lw 1 lc rgb '#555555'");
        line("set tics out nomirror scale 0.5");
        line("set xtics offset 0, 0.3");
        line("set grid lt 1 lw 1 lc rgb '#e4e4e4'");
        line("set clip two");
        for (const Panel& panel : figure_.panels) draw(panel);
        line("unset multiplot");
        return out_;
    }

private:
    template <typename... Values>
    void line(fmt::format_string<Values...> pattern, Values&&... values) {
        fmt::format_to(std::back_inserter(out_), pattern, std::forward<Values>(values)...);
        out_ += '\n';
    }

    double across(double pixels) const { return pixels / figure_.width; }
    double up(double pixels) const { return 1 - pixels / figure_.height; }

    void draw(const Panel& panel) {
        const Numbering x = numbering(panel.x, panel.right - panel.left, pixels_per_x_number);
        const Numbering y = numbering(panel.y, panel.bottom - panel.top, pixels_per_y_number);
        line("unset object; unset label; unset arrow");
        line("set lmargin at screen {:.5f}; set rmargin at screen {:.5f}", across(panel.left), across(panel.right));
        line("set tmargin at screen {:.5f}; set bmargin at screen {:.5f}", up(panel.top), up(panel.bottom));
        line("set xrange [{:.12g}:{:.12g}]; set yrange [{:.12g}:{:.12g}]", panel.x.from * x.scale, panel.x.to * x.scale, panel.y.from * y.scale, panel.y.to * y.scale);
        line("set xtics {:.12g}; set ytics {:.12g}", x.step, y.step);
        line("set format y '%.{}f'", y.decimals);
        if (panel.x.shown) line("set format x '%.{}f'", x.decimals);
        else line("set format x ''");
        for (const Interval& band : panel.bands) {
            const double from = std::max(band.from, panel.y.from) * y.scale;
            const double to = std::min(band.to, panel.y.to) * y.scale;
            if (from < to) line("set object rectangle from graph 0, first {:.12g} to graph 1, first {:.12g} behind fc rgb '#d9d9d9' fs solid noborder", from, to);
            // Its edges lie in front: a dense line covers the band.
            for (const double edge : {band.from, band.to}) {
                if (edge <= panel.y.from || edge >= panel.y.to) continue;
                line("set arrow from graph 0, first {0:.12g} to graph 1, first {0:.12g} nohead front dashtype (6,4) lw 1 lc rgb '#333333'", edge * y.scale);
            }
        }
        for (const Tint& tint : panel.marked) {
            const double from = std::max(tint.over.from, panel.x.from) * x.scale;
            const double to = std::min(tint.over.to, panel.x.to) * x.scale;
            if (from < to) line("set object rectangle from first {:.12g}, graph 0 to first {:.12g}, graph 1 behind fc rgb '{}' fs transparent solid 0.16 noborder", from, to, tint.colour);
        }
        const double middle = 0.5 * (panel.top + panel.bottom);
        const Label y_label = label(panel.y, y, panel.bottom - panel.top);
        line("set label {} at screen {:.5f}, screen {:.5f} rotate by 90 center font ',{}'", quoted(y_label.text), across(panel.left - room_left + label_line), up(middle), y_label.font);
        if (panel.x.shown) {
            const Label x_label = label(panel.x, x, panel.right - panel.left);
            line("set label {} at screen {:.5f}, screen {:.5f} center font ',{}'", quoted(x_label.text), across(0.5 * (panel.left + panel.right)), up(panel.bottom + room_below - label_line), x_label.font);
        }
        for (const auto& [place, text] : panel.headings) {
            const double share = (place - panel.x.from) / (panel.x.to - panel.x.from);
            line("set label {} at screen {:.5f}, screen {:.5f} center textcolor rgb '#555555'", quoted(text), across(panel.left + share * (panel.right - panel.left)), up(panel.top - 10));
        }
        std::vector<std::string> plots;
        for (std::size_t k = 0; k < panel.areas.size(); ++k) {
            if (fill(panel.areas[k], k, x.scale, y.scale)) plots.push_back(fmt::format("$a{} using 1:2:3 with filledcurves fs solid noborder lc rgb '{}' title {}", k, panel.areas[k].colour, quoted(panel.areas[k].title)));
        }
        for (std::size_t k = 0; k < panel.drawn.size(); ++k) {
            const Drawn& drawn = panel.drawn[k];
            if (!data(drawn, k, x.scale, y.scale, 0.1 * (panel.x.to - panel.x.from) * x.scale / (panel.right - panel.left))) continue;
            plots.push_back(fmt::format("$d{} using 1:2 with lines lt 1 lw {:.3g} lc rgb '{}' title {}", k, drawn.width, drawn.colour, quoted(drawn.title)));
        }
        // Without a series the axes are still drawn, by a function that is nowhere.
        line("plot {}", plots.empty() ? "NaN notitle" : fmt::format("{}", fmt::join(plots, ", ")));
    }

    /// The data block $dK; false where nothing is in it. A dot is a stroke of length `dot` with round ends: a third of the bytes of a symbol.
    bool data(const Drawn& drawn, std::size_t k, double x_scale, double y_scale, double dot) {
        bool any = false;
        std::string block;
        for (std::size_t i = 0; i < drawn.curve.x.size(); ++i) {
            const double x = drawn.curve.x[i] * x_scale;
            const double y = drawn.curve.y[i] * y_scale;
            if (!std::isfinite(x) || !std::isfinite(y)) {
                block += '\n';
                continue;
            }
            any = true;
            fmt::format_to(std::back_inserter(block), "{:.9g} {:.7g}\n", x, y);
            if (drawn.points) fmt::format_to(std::back_inserter(block), "{:.9g} {:.7g}\n\n", x + dot, y);
        }
        if (any) line("$d{} << EOD\n{}EOD", k, block);
        return any;
    }

    /// The data block $aK; false where nothing is in it.
    bool fill(const Area& area, std::size_t k, double x_scale, double y_scale) {
        bool any = false;
        std::string block;
        for (std::size_t i = 0; i < area.x.size(); ++i) {
            const bool here = std::isfinite(area.x[i]) && std::isfinite(area.low[i]) && std::isfinite(area.high[i]);
            if (here) fmt::format_to(std::back_inserter(block), "{:.9g} {:.7g} {:.7g}\n", area.x[i] * x_scale, area.low[i] * y_scale, area.high[i] * y_scale);
            else block += '\n';
            any = any || here;
        }
        if (any) line("$a{} << EOD\n{}EOD", k, block);
        return any;
    }

    const Figure& figure_;
    std::string out_;
};

}  // namespace

std::string gnuplot_script(const Figure& figure) { return Script(figure).text(); }

}  // namespace algest::lab
