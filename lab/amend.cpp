// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/amend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/bound_edits.hpp"
#include "lab/outputs.hpp"
#include "lab/placeholders.hpp"
#include "lab/roles.hpp"
#include "lab/turned.hpp"

namespace algest::lab {

namespace {

/// Byte offset of a position in a text.
std::size_t offset_of(const std::string& text, Position at) {
    std::size_t offset = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
    for (int line = 1; line < at.line; ++line) offset = text.find('\n', offset) + 1;
    for (int column = 1; column < at.column; ++column) {
        ++offset;
        while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0U) == 0x80U) ++offset;
    }
    return offset;
}

int highest_order(const formula::Formula& f) {
    int order = 0;
    if (formula::is_derivative(f)) order = formula::derivative_order(f);
    for (const formula::Formula& a : f->arguments) order = std::max(order, highest_order(a));
    return order;
}

/// With which sign the derivative of this order stands in a formula; 0: it does not.
int sign_of_derivative(const formula::Formula& f, int order) {
    using formula::Kind;
    const auto of = [&](std::size_t k) { return sign_of_derivative(f->arguments[k], order); };
    switch (f->kind) {
        case Kind::call: return f->name == "der" && formula::derivative_order(f) == order ? 1 : 0;
        case Kind::negate: return -of(0);
        case Kind::add: return of(0) != 0 ? of(0) : of(1);
        case Kind::subtract: return of(0) != 0 ? of(0) : -of(1);
        case Kind::divide: return of(0);
        case Kind::multiply: {
            const std::size_t other = of(0) != 0 ? 1 : 0;
            return of(1 - other) * (f->arguments[other]->kind == Kind::negate ? -1 : 1);
        }
        default: return 0;
    }
}

/// To six digits, and not below the bound that stands beside it.
std::string value_text(const NewName& n) {
    const std::string rounded = fmt::format("{:.6g}", n.value);
    return n.min && !(std::stod(rounded) >= *n.min) ? fmt::format("{}", *n.min) : rounded;
}

/// The keys of a new name: "value = 1", "unit = ...".
std::vector<std::string> keys_of(const NewName& n) {
    std::vector<std::string> out = {(n.constant ? "value = " : "initial = ") + value_text(n)};
    if (!n.unit.empty()) out.push_back("unit = \"" + n.unit + "\"");
    if (n.min && !n.constant) out.push_back(fmt::format("min = {}", *n.min));
    return out;
}

/// Behind the line on which the last of these names is declared, if those lines hold one entry each; npos: nowhere.
template <class Names>
std::size_t behind_last(const std::string& text, const Names& names) {
    int line = 0;
    for (const auto& n : names) line = std::max(line, n.at.line);
    if (line == 0) return std::string::npos;
    const std::size_t start = offset_of(text, {line, 1});
    const std::size_t end = text.find('\n', start);
    const std::string content = text.substr(start, end == std::string::npos ? std::string::npos : end - start);
    if (content.find('[') < content.find('=') || content.find('}') == std::string::npos) return std::string::npos;   // a table of its own, or several lines
    return end == std::string::npos ? text.size() : end + 1;
}

/// Behind the line [table], with or without a comment; npos where there is none. A line of this kind inside a text of several lines would be taken
/// for it: the model is then none, which whoever asked for the amendment finds out by reading it.
std::size_t behind_header(const std::string& text, const std::string& table) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line = text.substr(at, end - at);
        line.erase(std::remove_if(line.begin(), line.end(), [](char c) { return c == ' ' || c == '\t' || c == '\r'; }), line.end());
        const std::size_t next = std::min(end + 1, text.size());
        if (line.substr(0, line.find('#')) == "[" + table + "]") return next;
        at = next;
    }
    return std::string::npos;
}

/// A file whose lines end with CRLF keeps doing so.
std::string with_crlf(const std::string& text) {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\n' && (k == 0 || text[k - 1] != '\r')) out += '\r';
        out += text[k];
    }
    return out;
}

/// Text that takes the place of [begin, end) of the file.
struct Splice {
    std::size_t begin;
    std::size_t end;
    std::string text;
};

bool is_word(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

/// A word, or the call of a function: nothing beside it binds tighter.
bool stands_alone(const std::string& text) {
    const std::size_t open = text.find('(');
    if (open == std::string::npos || open == 0 || !is_word(text.substr(0, open))) return is_word(text);
    int depth = 0;
    for (std::size_t at = open; at < text.size(); ++at) {
        if (text[at] == '(') ++depth;
        else if (text[at] == ')' && --depth == 0) return at + 1 == text.size();
    }
    return false;
}

/// Edits of one text, collected by the positions that it has before them.
class Edits {
public:
    Edits(const std::string& text, const model::Model& model) : text_(text), model_(model) {}

    void add_term(std::size_t equation, const std::string& written) {
        const model::Equation& e = model_.equations[equation];
        const bool leading_left = highest_order(e.sides.left) >= highest_order(e.sides.right);
        const formula::Formula& leading_side = leading_left ? e.sides.left : e.sides.right;
        // Beside the driving terms: across from the leading derivative, or next to it where it stands among them with a minus.
        const bool across = sign_of_derivative(leading_side, highest_order(leading_side)) >= 0;
        std::string term = output_of(model_, e) < 0 ? written : turned(written);   // F = c*v says 0 = F - c*v: what resists grows F
        if (term[0] == '-' || term[0] == '+') term = term.substr(0, 1) + " " + term.substr(term[1] == ' ' ? 2 : 1);
        else term = "+ " + term;
        std::size_t at = offset_of(text_, e.place(static_cast<int>(leading_left == across ? e.ode.size() : e.ode.find('='))));
        while (at > 0 && text_[at - 1] == ' ') --at;
        insert(at, " " + term);
    }

    void substitute(const Substitution& s) {
        const model::Equation& e = model_.equations[s.equation];
        const Places places = places_of(s, model_);
        for (const Stretch& at : places.plain) {
            replace(e, at, is_reversed(s, e, at) ? "-" + in_parentheses(s.by) : s.by);
        }
        for (const Stretch& at : places.derivatives) {
            const std::string written = e.ode.substr(at.begin, at.end - at.begin);
            if (!s.derivative.empty()) replace(e, at, filled(s.derivative, {{"derivative", s.what[0] == '(' ? in_parentheses(written) : written}}));
            else if (is_word(s.by)) replace(e, at, of_another_signal(written, s.what, s.by));
        }
    }

    /// An entry of a table, behind the last one that stands on a line of its own, or behind the header; else a table of its own at the end.
    template <class Names>
    void declare(const Names& declared, const std::string& table, const std::string& name, const std::vector<std::string>& keys, const std::string& because) {
        const std::size_t where = place_of_entries(declared, table);
        if (where != std::string::npos) {
            insert_line(where, fmt::format("{} = {{ {} }}   # {}\n", name, fmt::join(keys, ", "), because));
        } else {
            own_tables_ += fmt::format("\n[{}.{}]   # {}\n{}\n", table, name, because, fmt::join(keys, "\n"));
        }
    }

    void add_equation(const NewState& s) {
        insert(behind_equations(), fmt::format("\n[[equation]]\nname = \"{}\"\node = \"{}\"\n", s.equation, s.ode));
    }

    /// The constant's entry becomes one of a parameter; false where it is written in a way that this cannot move.
    bool let_go(const NewName& n) {
        const model::Constant& c = *model_.constant(n.name);
        const std::size_t start = offset_of(text_, {c.at.line, 1});
        const std::size_t end = std::min(text_.find('\n', start), text_.size() - 1) + 1;
        std::string entry = text_.substr(start, end - start);
        const std::size_t value = entry.find("value");
        const std::size_t equals = entry.find('=');
        if (equals == std::string::npos || value == std::string::npos || value < equals || entry.find('}') == std::string::npos) return false;
        const std::size_t number = entry.find_first_not_of(" \t", entry.find('=', value) + 1);
        const std::size_t behind = entry.find_first_of(",} \t", number);
        entry.replace(number, behind - number, value_text(n));
        entry.replace(value, 5, "initial");
        const std::size_t where = place_of_entries(model_.parameters, "parameters");
        splices_.push_back({start, end, ""});
        if (where != std::string::npos) insert_line(where, entry);
        else own_tables_ += "\n[parameters]\n" + entry;
        return true;
    }

    std::string done() {
        // Later places first, so that earlier positions stay right; what comes to one place keeps its order.
        std::stable_sort(splices_.begin(), splices_.end(), [](const Splice& a, const Splice& b) { return a.begin > b.begin; });
        std::string out = text_;
        for (std::size_t k = 0; k < splices_.size();) {
            std::size_t same = k;
            std::size_t end = splices_[k].end;
            std::string joined;
            for (; same < splices_.size() && splices_[same].begin == splices_[k].begin; ++same) {
                joined += splices_[same].text;
                end = std::max(end, splices_[same].end);
            }
            out.replace(splices_[k].begin, end - splices_[k].begin, joined);
            k = same;
        }
        if (!own_tables_.empty() && !out.empty() && out.back() != '\n') out += "\n";
        out += own_tables_;
        return text_.find("\r\n") == std::string::npos ? out : with_crlf(out);
    }

private:
    /// Where another entry of the table can stand; npos where it can only have a table of its own.
    template <class Names>
    std::size_t place_of_entries(const Names& declared, const std::string& table) const {
        const std::size_t where = behind_last(text_, declared);
        return where != std::string::npos ? where : behind_header(text_, table);
    }

    /// True for b - a in the place of (a-b).
    static bool is_reversed(const Substitution& s, const model::Equation& e, const Stretch& at) {
        if (s.what[0] != '(') return false;
        const std::string first = s.what.substr(1, s.what.find('-') - 1);
        return e.ode.compare(at.begin, first.size(), first) != 0 || is_word(e.ode.substr(at.begin, first.size() + 1));
    }

    /// der(x,2) -> der(y,2).
    static std::string of_another_signal(std::string derivative, const std::string& signal, const std::string& other) {
        return derivative.replace(derivative.find(signal, derivative.find('(')), signal.size(), other);
    }

    static std::string in_parentheses(const std::string& text) { return "(" + text + ")"; }

    /// A line of its own, also behind a last line that does not end.
    void insert_line(std::size_t at, const std::string& line) {
        const bool needs_break = at == text_.size() && !text_.empty() && text_.back() != '\n';
        insert(at, (needs_break ? "\n" : "") + line);
    }

    void insert(std::size_t at, std::string text) { splices_.push_back({at, at, std::move(text)}); }

    /// In parentheses, unless it stands alone or in parentheses already.
    void replace(const model::Equation& e, const Stretch& at, const std::string& by) {
        const bool enclosed = at.begin > 0 && e.ode[at.begin - 1] == '(' && at.end < e.ode.size() && e.ode[at.end] == ')';
        splices_.push_back({offset_of(text_, e.place(static_cast<int>(at.begin))), offset_of(text_, e.place(static_cast<int>(at.end))), enclosed || stands_alone(by) ? by : in_parentheses(by)});
    }

    /// Behind the last line of the last [[equation]].
    std::size_t behind_equations() const {
        int line = 1;
        for (const model::Equation& e : model_.equations) line = std::max(line, e.at.line);
        std::size_t out = text_.size();
        for (std::size_t at = offset_of(text_, {line, 1}); at < text_.size();) {
            const std::size_t next = std::min(text_.find('\n', at), text_.size() - 1) + 1;
            const std::size_t first = text_.find_first_not_of(" \t\r", at);
            if (first < next && text_[first] == '[') break;
            if (first < next && text_[first] != '\n' && text_[first] != '#') out = next;
            at = next;
        }
        return out;
    }

    const std::string& text_;
    const model::Model& model_;
    std::vector<Splice> splices_;
    std::string own_tables_;
};

}  // namespace

std::string amended(const std::string& text, const model::Model& model, const Amendment& a) {
    // An amendment found beside another one may stand in an equation that only that one brings.
    const auto is_missing = [&](std::size_t equation) { return equation >= model.equations.size(); };
    if (std::any_of(a.equations.begin(), a.equations.end(), is_missing)) return "";
    if (std::any_of(a.substitutions.begin(), a.substitutions.end(), [&](const Substitution& s) { return is_missing(s.equation); })) return "";
    Edits edits(text, model);
    for (std::size_t k = 0; k < a.equations.size(); ++k) if (!a.terms[k].empty()) edits.add_term(a.equations[k], a.terms[k]);
    for (const Substitution& s : a.substitutions) edits.substitute(s);
    if (!a.time.empty()) {
        std::vector<std::string> keys = {"unit = \"s\""};
        if (a.time != time_column) keys.push_back(fmt::format("column = \"{}\"", time_column));
        edits.declare(model.signals, "signals", a.time, keys, a.because);
    }
    for (const NewState& s : a.states) {
        std::vector<std::string> keys = {fmt::format("initial = {}", s.initial), "scored = false"};
        if (!s.unit.empty()) keys.insert(keys.begin(), "unit = \"" + s.unit + "\"");
        edits.declare(model.signals, "signals", s.name, keys, a.because);
        edits.add_equation(s);
    }
    for (const NewName& n : a.names) {
        if (n.let_go) {
            if (!edits.let_go(n)) return "";
        } else if (n.constant) {
            edits.declare(model.constants, "constants", n.name, keys_of(n), a.because);
        } else {
            edits.declare(model.parameters, "parameters", n.name, keys_of(n), a.because);
        }
    }
    return edits.done();
}

std::string amended_in_turn(const std::string& text, const std::string& path, const std::vector<Amendment>& amendments) {
    std::string out = text;
    for (const Amendment& a : amendments) {
        Diagnostics quiet;
        const auto model = model::read_from_text(out, path, false, quiet);
        if (!model) return "";
        out = amended(out, *model, a);
    }
    return out;
}

}  // namespace algest::lab
