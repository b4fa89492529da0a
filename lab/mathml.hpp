// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas for a page: the LaTeX in which the generator writes its derivations, as MathML.
#pragma once
#include <string>
#include <string_view>

namespace algest::lab {

/// A formula of the part of LaTeX that derivations use: letters, numbers, signs, sub- and superscripts, primes, \frac, \tfrac, \sqrt, \overline,
/// \left and \right, \mathrm, \operatorname, \text, Greek letters, names of functions, spaces; with `display` also the rows and columns
/// of align*. A command that it does not know stays as its own text. Cost: linear; nesting beyond 200 is left as text.
std::string mathml(std::string_view latex, bool display);

/// A fragment of a document: paragraphs, \section*, \subsection*, \texttt, $...$, equation* and align*; comments are left out.
std::string html_of_latex(std::string_view latex);

}  // namespace algest::lab
