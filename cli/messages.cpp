// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/messages.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

const char* severity_name(Severity severity) {
    switch (severity) {
        case Severity::note: return "note";
        case Severity::warning: return "warning";
        case Severity::unidentifiable: return "not identifiable";
        case Severity::error: return "error";
    }
    return "?";
}

const char* colour(Severity severity) {
    switch (severity) {
        case Severity::note: return "\033[36m";
        case Severity::warning: return "\033[35m";
        case Severity::unidentifiable:
        case Severity::error: return "\033[1;31m";
    }
    return "";
}

/// Files may hold anything: no control character of theirs reaches the terminal.
std::string without_controls(std::string text) {
    for (char& c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte < 0x20U && c != '\n') || byte == 0x7FU) c = '?';
    }
    return text;
}

std::string coloured(const Diagnostic& diagnostic, const std::string& text) {
    const std::string word = severity_name(diagnostic.severity);
    const std::size_t at = text.find(": " + word + ": ", diagnostic.file.size());
    if (at == std::string::npos) return text;
    return text.substr(0, at + 2) + colour(diagnostic.severity) + word + "\033[0m" + text.substr(at + 2 + word.size());
}

ordered_json number_or_null(int value) { return value > 0 ? ordered_json(value) : ordered_json(nullptr); }

ordered_json chosen_json(const Diagnostics& diagnostics, bool errors) {
    ordered_json out = ordered_json::array();
    for (const Diagnostic& d : diagnostics.sorted()) {
        const bool is_error = d.severity == Severity::error || d.severity == Severity::unidentifiable;
        if (errors ? !is_error : d.severity != Severity::warning) continue;
        out.push_back({{"severity", severity_name(d.severity)},
                       {"file", d.file},
                       {"line", number_or_null(d.at.line)},
                       {"column", number_or_null(d.at.column)},
                       {"what", d.what},
                       {"right", d.right}});
    }
    return out;
}

}  // namespace

int exit_code(const Diagnostics& diagnostics) {
    if (diagnostics.has_errors()) return exit_bad_input;
    return diagnostics.is_unidentifiable() ? exit_no : exit_done;
}

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) != 0; }

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_json(const ordered_json& object) {
    print(object.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

void note(const std::string& text) { std::fputs((without_controls(text) + "\n").c_str(), stderr); }

void print_diagnostics(const Diagnostics& diagnostics) {
    const char* const no_colour = std::getenv("NO_COLOR");
    const bool in_colour = is_terminal(stderr) && (no_colour == nullptr || *no_colour == '\0');
    for (const Diagnostic& d : diagnostics.sorted()) {
        const std::string text = without_controls(d.text());
        std::fputs(((in_colour ? coloured(d, text) : text) + "\n").c_str(), stderr);
    }
}

ordered_json errors_json(const Diagnostics& diagnostics) { return chosen_json(diagnostics, true); }

ordered_json warnings_json(const Diagnostics& diagnostics) { return chosen_json(diagnostics, false); }

void Outcome::take(const Diagnostics& diagnostics) {
    print_diagnostics(diagnostics);
    code_ = std::max(code_, exit_code(diagnostics));
    for (ordered_json& error : errors_json(diagnostics)) errors_.push_back(std::move(error));
}

void Outcome::say_no() { code_ = std::max(code_, exit_no); }

void Outcome::print_result(const ordered_json& result, bool json) const {
    if (!json) return;
    ordered_json object = ordered_json::object();
    if (!errors_.empty()) object["error"] = errors_;
    object.update(result);
    print_json(object);
}

int fail(const Diagnostics& diagnostics, bool json) {
    print_diagnostics(diagnostics);
    if (json) print_json({{"error", errors_json(diagnostics)}});
    return exit_code(diagnostics);
}

bool output_failed() { return std::fflush(stdout) != 0 || std::ferror(stdout) != 0; }

}  // namespace algest::cli
