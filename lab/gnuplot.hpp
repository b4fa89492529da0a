// SPDX-License-Identifier: GPL-3.0-or-later
// Runs gnuplot: a script on its standard input, the SVG from its standard output; no shell, no file with a name.
#pragma once
#include <functional>
#include <string>

namespace algest::lab {

/// What came of a script.
struct Drawing {
    enum class Outcome { drawn, not_installed, failed };
    Outcome outcome;
    std::string svg;         ///< as gnuplot prints it
    std::string complaint;   ///< why it failed
};

using Draw = std::function<Drawing(const std::string& script)>;

/// Runs `gnuplot -d` (no start-up file of the user's) from PATH.
Drawing gnuplot(const std::string& script);

/// The <svg> element to stand inside an HTML page beside others: without prolog and without the symbols of points, which
/// gnuplot_script() never uses; every id begun with `prefix`, which so is unique in the page; with a title of its own.
std::string inline_svg(const std::string& svg, const std::string& prefix, const std::string& title);

}  // namespace algest::lab
