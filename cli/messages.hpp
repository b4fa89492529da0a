// SPDX-License-Identifier: GPL-3.0-or-later
// What the commands say: diagnostics to standard error for people, and as JSON for programs; exit codes.
#pragma once
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

#include "generator/diagnostics.hpp"

namespace algest::cli {

/// Exit codes of every command.
constexpr int exit_done = 0;  ///< done, or the answer is yes
constexpr int exit_no = 1;    ///< the answer is no
constexpr int exit_bad_input = 2;

/// The exit code that the diagnostics ask for.
int exit_code(const Diagnostics& diagnostics);

/// True when people read the stream.
bool is_terminal(std::FILE* stream);

/// To standard output. What could not be written is found by `output_failed` at the end.
void print(const std::string& text);
/// One object, indented, to standard output. Text that is not UTF-8 gets replacement characters.
void print_json(const nlohmann::ordered_json& object);
/// One line to standard error.
void note(const std::string& text);
/// All diagnostics to standard error, in the order of line and column; in colour on a terminal unless NO_COLOR is set.
void print_diagnostics(const Diagnostics& diagnostics);

/// Errors (and "not identifiable") as an array of {"severity", "file", "line", "column", "what", "right"}; unknown is null.
nlohmann::ordered_json errors_json(const Diagnostics& diagnostics);
/// The same of warnings.
nlohmann::ordered_json warnings_json(const Diagnostics& diagnostics);

/// What came of several models, each with diagnostics of its own.
class Outcome {
public:
    /// Prints the diagnostics of one model to standard error; the worst exit code and all errors are kept.
    void take(const Diagnostics& diagnostics);
    /// An answer that is no, without a diagnostic.
    void say_no();
    int code() const { return code_; }

    /// With `json`, prints `result`; after an error with "error": [...] in front.
    void print_result(const nlohmann::ordered_json& result, bool json) const;

private:
    int code_ = exit_done;
    nlohmann::ordered_json errors_ = nlohmann::ordered_json::array();
};

/// How a command fails: diagnostics to standard error, {"error": [...]} to standard output if `json`; the exit code.
int fail(const Diagnostics& diagnostics, bool json);

/// Flushes standard output; true if something could not be written (a full disk).
bool output_failed();

}  // namespace algest::cli
