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
}  // namespace

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
