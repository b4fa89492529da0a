// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/mathml.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "lab/html_text.hpp"

namespace algest::lab {

namespace {

constexpr int deepest_nesting = 200;

using Symbol = std::pair<std::string_view, std::string_view>;

constexpr std::array<Symbol, 26> letters = {{
    {"alpha", "\u03b1"}, {"beta", "\u03b2"}, {"gamma", "\u03b3"}, {"delta", "\u03b4"}, {"epsilon", "\u03b5"}, {"zeta", "\u03b6"}, {"eta", "\u03b7"},
    {"theta", "\u03b8"}, {"kappa", "\u03ba"}, {"lambda", "\u03bb"}, {"mu", "\u03bc"}, {"nu", "\u03bd"}, {"xi", "\u03be"}, {"pi", "\u03c0"},
    {"rho", "\u03c1"}, {"sigma", "\u03c3"}, {"tau", "\u03c4"}, {"phi", "\u03c6"}, {"chi", "\u03c7"}, {"psi", "\u03c8"}, {"omega", "\u03c9"},
    {"Gamma", "\u0393"}, {"Delta", "\u0394"}, {"Omega", "\u03a9"}, {"Pi", "\u03a0"}, {"Phi", "\u03a6"},
}};
constexpr std::array<Symbol, 7> operators = {{{"in", "\u2208"}, {"int", "\u222b"}, {"sum", "\u2211"}, {"dots", "\u2026"}, {"_", "_"}, {"#", "#"}, {"%", "%"}}};
constexpr std::array<Symbol, 4> spaces = {{{",", "0.17em"}, {" ", "0.33em"}, {"quad", "1em"}, {"qquad", "2em"}}};
constexpr std::array<std::string_view, 8> functions = {"sin", "cos", "tan", "exp", "log", "min", "max", "det"};

template <std::size_t size>
std::string_view looked_up(const std::array<Symbol, size>& table, std::string_view name) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const Symbol& s) { return s.first == name; });
    return found == table.end() ? std::string_view() : found->second;
}

std::string element(const std::string& name, const std::string& inside) { return "<" + name + ">" + inside + "</" + name + ">"; }
std::string upright(const std::string& text) { return "<mi mathvariant=\"normal\">" + html_text(text) + "</mi>"; }

/// Escapes of a name in \mathrm, \text and \texttt taken away.
std::string plain(std::string_view text) {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\\' && k + 1 < text.size()) ++k;
        out += text[k];
    }
    return out;
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    std::string whole() { return row([](const Parser& p) { return p.ended(); }); }

    /// Rows and columns of align*.
    std::string table() {
        std::string rows;
        while (!ended()) {
            std::string cells;
            for (;;) {
                cells += element("mtd", row([](const Parser& p) { return p.ended() || p.starts("&") || p.starts("\\\\"); }));
                if (!take("&")) break;
            }
            take("\\\\");
            rows += element("mtr", cells);
        }
        return "<mtable displaystyle=\"true\">" + rows + "</mtable>";
    }

private:
    bool ended() const { return at_ >= text_.size(); }
    bool starts(std::string_view what) const { return text_.substr(at_, what.size()) == what; }
    bool take(std::string_view what) {
        if (!starts(what)) return false;
        at_ += what.size();
        return true;
    }
    void skip_blanks() { while (!ended() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_; }

    template <typename Ends>
    std::string row(const Ends& ends) {
        std::string out;
        for (skip_blanks(); !ends(*this) && !ended(); skip_blanks()) out += scripted();
        return element("mrow", out);
    }

    /// An atom with what stands below and above it.
    std::string scripted() {
        std::string base = atom();
        std::string below, above, primes;
        for (skip_blanks(); !ended(); skip_blanks()) {
            if (take("_")) below = atom();
            else if (take("^")) above += atom();
            else if (take("'")) primes += "<mo lspace=\"0\" rspace=\"0\">&#8242;</mo>";   // the sign is a raised one
            else break;
        }
        if (!primes.empty()) base = element("mrow", base + primes);
        if (!above.empty()) above = element("mrow", above);
        if (!below.empty() && !above.empty()) return element("msubsup", base + below + above);
        if (!below.empty()) return element("msub", base + below);
        return above.empty() ? base : element("msup", base + above);
    }

    std::string atom() {
        skip_blanks();
        if (ended() || depth_ >= deepest_nesting) return rest_as_text();
        const auto c = static_cast<unsigned char>(text_[at_]);
        if (c == '\\') return command();
        if (c == '{') return group();
        std::size_t end = at_ + 1;
        if (std::isdigit(c) != 0) {
            while (end < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '.')) ++end;
        } else if (c >= 0x80U) {
            while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
        }
        const std::string text(text_.substr(at_, end - at_));
        at_ = end;
        if (std::isdigit(c) != 0) return element("mn", text);
        if (std::isalpha(c) != 0 || c >= 0x80U) return element("mi", html_text(text));
        return "<mo stretchy=\"false\">" + (c == '-' ? std::string("&#8722;") : html_text(text)) + "</mo>";
    }

    std::string rest_as_text() {
        const std::string text(text_.substr(std::min(at_, text_.size())));
        at_ = text_.size();
        return element("mtext", html_text(text));
    }

    /// `{ ... }`; a single atom where there is no brace.
    std::string group() {
        if (!take("{")) return atom();
        ++depth_;
        const std::string inside = row([](const Parser& p) { return p.starts("}"); });
        --depth_;
        take("}");
        return inside;
    }

    /// The text between braces.
    std::string raw_group() {
        if (!take("{")) return {};
        int open = 1;
        const std::size_t begin = at_;
        for (; !ended() && open > 0; ++at_) {
            if (text_[at_] == '\\') ++at_;
            else if (text_[at_] == '{') ++open;
            else if (text_[at_] == '}') --open;
        }
        at_ = std::min(at_, text_.size());
        return plain(text_.substr(begin, at_ - begin - (open == 0 ? 1 : 0)));
    }

    /// The sign behind \\left or \\right; "." is none.
    std::string fence() {
        skip_blanks();
        const std::string text(text_.substr(at_, ended() ? 0 : 1));
        at_ += text.size();
        return text == "." ? "" : html_text(text);
    }

    /// In fences as high as a fraction or root within; sub- and superscripts alone do not make them higher.
    static std::string fenced(const std::string& open, const std::string& inside, const std::string& close) {
        const bool high = inside.find("<mfrac>") != std::string::npos || inside.find("<msqrt>") != std::string::npos;
        const auto sign = [&](const std::string& text) { return text.empty() ? "" : "<mo fence=\"true\" stretchy=\"" + std::string(high ? "true" : "false") + "\">" + text + "</mo>"; };
        return element("mrow", sign(open) + inside + sign(close));
    }

    std::string command() {
        std::size_t end = at_ + 1;
        while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end])) != 0) ++end;
        if (end == at_ + 1 && end < text_.size()) ++end;
        const std::string name(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end;
        if (name == "frac" || name == "tfrac") {
            const std::string above = group();
            return element("mfrac", above + group());
        }
        if (name == "sqrt") return element("msqrt", group());
        if (name == "overline") return "<mover accent=\"true\">" + group() + "<mo stretchy=\"true\">&#175;</mo></mover>";
        if (name == "mathrm" || name == "operatorname") return upright(raw_group());
        if (name == "text") return element("mtext", html_text(raw_group()));
        if (name == "left") {
            const std::string open = fence();
            ++depth_;
            const std::string inside = row([](const Parser& p) { return p.starts("\\right"); });
            --depth_;
            take("\\right");
            return fenced(open, inside, fence());
        }
        if (const auto letter = looked_up(letters, name); !letter.empty()) return element("mi", std::string(letter));
        if (const auto sign = looked_up(operators, name); !sign.empty()) return element("mo", std::string(sign));
        if (const auto width = looked_up(spaces, name); !width.empty()) return "<mspace width=\"" + std::string(width) + "\"/>";
        if (std::find(functions.begin(), functions.end(), name) != functions.end()) return upright(name);
        return element("mtext", html_text("\\" + name));
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

/// The title between the braces of a section, a name in \\texttt as code.
std::string title_of(std::string_view line, std::string_view command) {
    constexpr std::string_view typewriter = "\\texttt{";
    const std::size_t end = line.rfind('}');
    std::string_view title = line.substr(command.size(), end == std::string_view::npos || end < command.size() ? line.size() : end - command.size());
    const std::size_t name = title.find(typewriter);
    const std::size_t name_end = title.rfind('}');
    if (name == std::string_view::npos || name_end == std::string_view::npos) return html_text(plain(title));
    std::string_view code = title.substr(name + typewriter.size(), name_end - name - typewriter.size());
    while (!code.empty() && code.front() == ' ') code.remove_prefix(1);
    while (!code.empty() && code.back() == ' ') code.remove_suffix(1);
    return html_text(plain(title.substr(0, name))) + "<code>" + html_text(plain(code)) + "</code>";
}

/// Prose with $...$ in it.
std::string prose(std::string_view text) {
    std::string out;
    for (;;) {
        const std::size_t open = text.find('$');
        const std::size_t close = open == std::string_view::npos ? open : text.find('$', open + 1);
        out += html_text(text.substr(0, close == std::string_view::npos ? text.size() : open));
        if (close == std::string_view::npos) return out;
        out += mathml(text.substr(open + 1, close - open - 1), false);
        text.remove_prefix(close + 1);
    }
}

}  // namespace

std::string mathml(std::string_view latex, bool display) {
    Parser parser(latex);
    return display ? "<math display=\"block\">" + parser.table() + "</math>" : "<math>" + parser.whole() + "</math>";
}

std::string html_of_latex(std::string_view latex) {
    constexpr std::string_view section = "\\section*{", subsection = "\\subsection*{", begin = "\\begin{", end = "\\end{";
    std::string out, paragraph, formula;
    bool in_formula = false;
    const auto flush = [&] {
        if (!paragraph.empty()) out += "<p>" + prose(paragraph) + "</p>\n";
        paragraph.clear();
    };
    while (!latex.empty()) {
        const std::size_t length = std::min(latex.find('\n'), latex.size());
        const std::string_view line = latex.substr(0, length);
        latex.remove_prefix(std::min(length + 1, latex.size()));
        const auto starts = [&](std::string_view what) { return line.substr(0, what.size()) == what; };
        if (in_formula && starts(end)) {
            out += "<div class=\"formula\">" + mathml(formula, true) + "</div>\n";
            formula.clear();
            in_formula = false;
        } else if (in_formula) {
            formula += std::string(line) + "\n";
        } else if (starts(begin)) {
            flush();
            in_formula = true;
        } else if (starts(section) || starts(subsection)) {
            flush();
            out += starts(section) ? "<h3>" + title_of(line, section) + "</h3>\n" : "<h4>" + title_of(line, subsection) + "</h4>\n";
        } else if (line.empty() || line[0] == '%') {
            flush();
        } else {
            paragraph += (paragraph.empty() ? "" : " ") + std::string(line);
        }
    }
    flush();
    return out;
}

}  // namespace algest::lab
