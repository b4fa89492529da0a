// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/amend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/placeholders.hpp"
#include "lab/roles.hpp"

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

/// Replaces a name where it stands as a whole word.
void rename(std::string& term, const std::string& from, const std::string& to) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = term.find(from); at != std::string::npos; at = term.find(from, at + 1)) {
        const bool starts = at == 0 || !is_word(term[at - 1]);
        const bool ends = at + from.size() == term.size() || !is_word(term[at + from.size()]);
        if (!starts || !ends) continue;
        term.replace(at, from.size(), to);
        at += to.size() - 1;
    }
}

bool taken(const std::string& name, const model::Model& model) {
    const auto same = [&](const std::string& other) {
        return other.size() == name.size() && std::equal(name.begin(), name.end(), other.begin(), [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
    };
    return std::any_of(model.signals.begin(), model.signals.end(), [&](const auto& s) { return same(s.name); }) ||
           std::any_of(model.constants.begin(), model.constants.end(), [&](const auto& c) { return same(c.name); }) ||
           std::any_of(model.parameters.begin(), model.parameters.end(), [&](const auto& p) { return same(p.name); });
}

std::string fresh(const std::string& wanted, const model::Model& model) {
    std::string name = wanted;
    for (int k = 2; taken(name, model); ++k) name = wanted + std::to_string(k);
    return name;
}

int highest_order(const formula::Formula& f) {
    int order = 0;
    if (f->kind == formula::Kind::call && f->name == "der") order = f->arguments.size() > 1 ? cln::cl_I_to_int(cln::numerator(f->arguments[1]->value)) : 1;
    for (const formula::Formula& a : f->arguments) order = std::max(order, highest_order(a));
    return order;
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
    if (n.min) out.push_back(fmt::format("min = {}", *n.min));
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

/// A file whose lines end with CRLF keeps doing so.
std::string with_crlf(const std::string& text) {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\n' && (k == 0 || text[k - 1] != '\r')) out += '\r';
        out += text[k];
    }
    return out;
}

}  // namespace

Amendment amendment(const Binding& binding, const model::Model& model, double scan) {
    const Effect& effect = *binding.effect;
    std::vector<std::string> terms = binding.terms;
    Amendment out{effect.name, binding.equations, {}, {}, "", "", effect.summary};
    if (binding.roles[0].size() == 1 && model.signal_index(binding.roles[0].begin()->second) >= 0) out.against = binding.roles[0].begin()->second;
    for (const auto& [role, kind] : effect.roles) if (kind == "time" && model.signal_index(time_name(model)) < 0) out.time = time_name(model);
    std::map<std::string, std::string> units = binding.role_units;
    units["equation"] = binding.unit;
    for (const EffectParameter& p : effect.parameters) {
        const std::string name = fresh(p.name, model);
        for (std::string& term : terms) rename(term, p.name, name);
        out.names.push_back({name, filled(p.unit, units), 0.0, p.min, false});
    }
    for (const EffectScan& s : effect.scans) {
        const std::string name = fresh(s.name, model);
        for (std::string& term : terms) rename(term, s.name, name);
        out.names.push_back({name, filled(s.unit, units), scan, std::nullopt, true});
    }
    for (std::size_t k = 0; k < terms.size(); ++k) out.terms.push_back(filled(terms[k], binding.roles[k]));
    return out;
}

std::string amended(const std::string& text, const model::Model& model, const Amendment& amendment) {
    std::string out = text;
    std::vector<std::pair<std::size_t, std::string>> insertions;
    for (std::size_t k = 0; k < amendment.equations.size(); ++k) {
        const model::Equation& equation = model.equations[amendment.equations[k]];
        const bool leading_left = highest_order(equation.sides.left) >= highest_order(equation.sides.right);
        const std::size_t place = leading_left ? equation.ode.size() : equation.ode.find('=');
        std::string term = amendment.terms[k];
        if (term[0] == '-' || term[0] == '+') term = term.substr(0, 1) + " " + term.substr(1);
        else term = "+ " + term;
        std::size_t at = offset_of(out, equation.place(static_cast<int>(place)));
        while (at > 0 && out[at - 1] == ' ') --at;
        insertions.emplace_back(at, " " + term);
    }
    if (!amendment.time.empty()) {
        const std::string entry = amendment.time + " = { unit = \"s\"" + (amendment.time == time_column ? "" : std::string(", column = \"") + time_column + "\"") + " }   # " + amendment.because + "\n";
        const std::size_t where = behind_last(out, model.signals);
        if (where != std::string::npos) insertions.emplace_back(where, entry);
        else out += "\n[signals." + amendment.time + "]\nunit = \"s\"\ncolumn = \"" + time_column + "\"\n";
    }
    // Later places first, so that earlier positions stay right.
    const std::size_t parameters = behind_last(out, model.parameters);
    const std::size_t constants = behind_last(out, model.constants);
    std::string own_tables;
    for (const NewName& n : amendment.names) {
        const std::size_t where = n.constant ? constants : parameters;
        if (where != std::string::npos) {
            const bool needs_break = where == out.size() && !out.empty() && out.back() != '\n';
            insertions.emplace_back(where, fmt::format("{}{} = {{ {} }}   # {}\n", needs_break ? "\n" : "", n.name, fmt::join(keys_of(n), ", "), amendment.because));
        } else {
            own_tables += fmt::format("\n[{}.{}]   # {}\n{}\n", n.constant ? "constants" : "parameters", n.name, amendment.because, fmt::join(keys_of(n), "\n"));
        }
    }
    std::stable_sort(insertions.begin(), insertions.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    // Entries for one place keep their order: insert the last first.
    for (std::size_t k = 0; k < insertions.size();) {
        std::size_t same = k;
        std::string joined;
        while (same < insertions.size() && insertions[same].first == insertions[k].first) joined += insertions[same++].second;
        out.insert(insertions[k].first, joined);
        k = same;
    }
    if (!own_tables.empty() && !out.empty() && out.back() != '\n') out += "\n";
    out += own_tables;
    return text.find("\r\n") == std::string::npos ? out : with_crlf(out);
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
