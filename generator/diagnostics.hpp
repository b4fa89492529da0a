// SPDX-License-Identifier: GPL-3.0-or-later
// Complaints about a user's file: where, what is wrong, what would be right. Collected, so that one run shows them all.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace algest {

/// A place in a text file; line and column count from 1, columns in characters (UTF-8 code points). 0: unknown.
struct Position {
    int line = 0;
    int column = 0;
};

enum class Severity { note, warning, unidentifiable, error };

struct Diagnostic {
    Severity severity;
    std::string file;
    Position at;
    std::string what;    ///< what is wrong
    std::string right;   ///< what would be right; may be empty

    /// `file:line:column: error: what; right`
    std::string text() const;
};

/// A piece of the user's text in a message, in quotes: shortened, with '?' for control characters and for what is no UTF-8.
std::string quoted(std::string_view text);

class Diagnostics {
public:
    void error(const std::string& file, Position at, std::string what, std::string right = {});
    void warning(const std::string& file, Position at, std::string what, std::string right = {});
    void unidentifiable(const std::string& file, Position at, std::string what, std::string right = {});
    void note(const std::string& file, std::string what);

    bool has_errors() const;            ///< bad input: exit 2
    bool is_unidentifiable() const;     ///< the answer is no: exit 1
    bool failed() const { return has_errors() || is_unidentifiable(); }
    bool has_warnings() const;
    /// All, in the order of line and column.
    std::vector<Diagnostic> sorted() const;

private:
    void add(Diagnostic diagnostic);
    std::vector<Diagnostic> all_;
};

}  // namespace algest
