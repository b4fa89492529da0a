// SPDX-License-Identifier: GPL-3.0-or-later
// What the pages of all reports share: texts and quantities as a template takes them, figures, style.
#pragma once
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/render.hpp"
#include "lab/figure.hpp"
#include "lab/gnuplot.hpp"

namespace algest::lab {

using generator::Data;
using generator::DataList;

/// Every text goes into a page through here: escaped.
void set_text(Data& data, const std::string& name, const std::string& text);
/// Data with one text.
Data entry(const std::string& name, const std::string& text);
/// Sets `NAME` and `has_NAME`.
void set_list(Data& data, const std::string& name, DataList list);

/// A value with its standard deviation (0: a constant; infinite: the data do not see it) as PREFIXvalue, PREFIXsd, PREFIXexponent,
/// PREFIXhas_sd, PREFIXhas_exponent, PREFIXunseen, PREFIXchosen_constant.
void set_quantity(Data& data, const std::string& prefix, double value, double sd);

/// A unit as a reader sees it.
std::string unit_text(const std::string& unit);

/// A word that a shell takes as it is; several, with blanks between.
std::string shell_word(const std::string& text);
std::string shell_words(const std::vector<std::string>& texts);

/// Sets `style`, from templates/report/style.css.mustache.
void set_style(Data& page);

/// Draws figures until the first that cannot be for want of gnuplot; says so once.
class Figures {
public:
    Figures(const Draw& draw, Diagnostics& diagnostics) : draw_(draw), diagnostics_(diagnostics) {}

    /// Sets `drawn`, `svg` and `panels`.
    void set(Data& data, const Figure& figure);
    /// Sets `no_gnuplot` and `figure_failed`, when all figures are drawn.
    void set_complaints(Data& page) const;

private:
    const Draw& draw_;
    Diagnostics& diagnostics_;
    int count_ = 0;
    bool missing_ = false;
    bool failed_ = false;
};

}  // namespace algest::lab
