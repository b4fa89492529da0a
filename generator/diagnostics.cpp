// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/diagnostics.hpp"

#include <algorithm>
#include <tuple>

namespace algest {

namespace {
const char* word(Severity severity) {
    switch (severity) {
        case Severity::note: return "note";
        case Severity::warning: return "warning";
        case Severity::unidentifiable: return "not identifiable";
        case Severity::error: return "error";
    }
    return "?";
}

/// Bytes of the UTF-8 character at the start of the text; 0 if there is none.
std::size_t character_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((static_cast<unsigned char>(text[k]) & 0xC0U) != 0x80U) return 0;
    }
    return length;
}

/// U+0000 to U+001F, U+007F to U+009F.
bool is_control(std::string_view character) {
    const auto last = static_cast<unsigned char>(character.back());
    if (character.size() == 1) return last < 0x20 || last == 0x7F;
    return character.size() == 2 && static_cast<unsigned char>(character.front()) == 0xC2 && last < 0xA0;
}
}  // namespace

std::string quoted(std::string_view text) {
    constexpr std::size_t most = 60;
    std::string out = "'";
    while (!text.empty() && out.size() <= most) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        out += length == 0 || is_control(character) ? "?" : character;
        text.remove_prefix(character.size());
    }
    return out + (text.empty() ? "'" : "...'");
}

std::string Diagnostic::text() const {
    std::string out = file;
    if (at.line > 0) out += ":" + std::to_string(at.line);
    if (at.line > 0 && at.column > 0) out += ":" + std::to_string(at.column);
    out += ": ";
    out += word(severity);
    out += ": " + what;
    if (!right.empty()) out += "; " + right;
    return out;
}

void Diagnostics::add(Diagnostic diagnostic) {
    for (const Diagnostic& d : all_) {
        if (d.severity == diagnostic.severity && d.file == diagnostic.file && d.at.line == diagnostic.at.line &&
            d.at.column == diagnostic.at.column && d.what == diagnostic.what) {
            return;
        }
    }
    all_.push_back(std::move(diagnostic));
}

void Diagnostics::error(const std::string& file, Position at, std::string what, std::string right) {
    add({Severity::error, file, at, std::move(what), std::move(right)});
}
void Diagnostics::warning(const std::string& file, Position at, std::string what, std::string right) {
    add({Severity::warning, file, at, std::move(what), std::move(right)});
}
void Diagnostics::unidentifiable(const std::string& file, Position at, std::string what, std::string right) {
    add({Severity::unidentifiable, file, at, std::move(what), std::move(right)});
}
void Diagnostics::note(const std::string& file, std::string what) {
    add({Severity::note, file, {}, std::move(what), {}});
}

bool Diagnostics::has_errors() const {
    return std::any_of(all_.begin(), all_.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
}
bool Diagnostics::is_unidentifiable() const {
    return std::any_of(all_.begin(), all_.end(), [](const Diagnostic& d) { return d.severity == Severity::unidentifiable; });
}
bool Diagnostics::has_warnings() const {
    return std::any_of(all_.begin(), all_.end(), [](const Diagnostic& d) { return d.severity == Severity::warning; });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
    std::vector<Diagnostic> out = all_;
    std::stable_sort(out.begin(), out.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.file, a.at.line, a.at.column) < std::tie(b.file, b.at.line, b.at.column);
    });
    return out;
}

}  // namespace algest
