// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "generator/formula.hpp"
#include "generator/source_text.hpp"

namespace algest::model {

namespace {

constexpr std::array<std::string_view, 99> cpp_words = {
    "alignas", "alignof", "and", "and_eq", "asm", "atomic_cancel", "atomic_commit", "atomic_noexcept", "auto", "bitand",
    "bitor", "bool", "break", "case", "catch", "char", "char8_t", "char16_t", "char32_t", "class", "compl", "concept",
    "const", "consteval", "constexpr", "constinit", "const_cast", "continue", "co_await", "co_return", "co_yield",
    "decltype", "default", "delete", "do", "double", "dynamic_cast", "else", "enum", "explicit", "export", "extern",
    "false", "float", "for", "friend", "goto", "if", "inline", "int", "long", "mutable", "namespace", "new", "noexcept",
    "not", "not_eq", "nullptr", "operator", "or", "or_eq", "private", "protected", "public", "reflexpr", "register",
    "reinterpret_cast", "requires", "return", "short", "signed", "sizeof", "static", "static_assert", "static_cast",
    "struct", "switch", "synchronized", "template", "this", "thread_local", "throw", "true", "try", "typedef", "typeid",
    "typename", "typeof", "union", "unsigned", "using", "virtual", "void", "volatile", "wchar_t", "while", "xor", "xor_eq", "main"};

// Members of every generated class, and macros that standard headers define.
constexpr std::array<std::string_view, 39> taken = {
    "algest", "std", "Status", "status", "condition", "reset", "push", "estimate", "step", "Sample", "Estimate", "Scalar", "uncertainty",
    "Uncertainty", "Deviations", "NAN", "INFINITY", "HUGE_VAL", "NULL", "EOF", "assert", "errno", "signbit", "isnan", "isinf", "isfinite", "linux", "unix",
    "M_E", "M_Ef", "M_El", "M_PI", "M_PIf", "M_PIl", "M_LN2", "M_LN10", "M_SQRT2", "RAND_MAX", "MAXFLOAT"};

// Models whose class would hide one that generated code uses.
constexpr std::array<std::string_view, 15> taken_by_runtime = {
    "blueprint", "boxcar_progress", "delay_progress", "estimate", "functional", "latest", "memory", "noise_channel", "parabola_filter", "progress", "sample", "scalar", "solve",
    "status", "term"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::optional<NameFault> fault_of_name(const std::string& name) {
    if (name.empty()) return NameFault{"an empty name", "give it one"};
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') {
            return NameFault{quoted(name) + " is not a name", "names are letters, digits and _, a letter first"};
        }
    }
    if (name.size() > static_cast<std::size_t>(formula::longest_name)) {
        return NameFault{"a name of " + std::to_string(name.size()) + " characters", "use at most " + std::to_string(formula::longest_name)};
    }
    if (std::isalpha(static_cast<unsigned char>(name[0])) == 0) {
        return NameFault{"'" + name + "' does not start with a letter", "names are letters, digits and _, a letter first"};
    }
    if (name.find("__") != std::string::npos || name.back() == '_') {
        return NameFault{"'" + name + "' is reserved in C++", "leave out the double or trailing underscore"};
    }
    if (contains(cpp_words, name)) return NameFault{"'" + name + "' is a C++ keyword", "choose another name, e.g. " + name + "1"};
    if (contains(taken, name)) return NameFault{"'" + name + "' is taken by generated code", "choose another name, e.g. " + name + "1"};
    // Macros of <cmath>, <cfloat>, <climits>, <cstdint>: M_PI, FP_NAN, SIZE_MAX, FLT_EPSILON.
    const auto starts = [&](std::string_view s) { return name.compare(0, s.size(), s) == 0; };
    const auto ends = [&](std::string_view s) { return name.size() > s.size() && name.compare(name.size() - s.size(), s.size(), s) == 0; };
    if (starts("M_") || starts("FP_") || starts("DBL_") || starts("FLT_") || ends("_MAX") || ends("_MIN")) {
        return NameFault{"'" + name + "' may be a macro of the standard headers", "choose another name, in lower case"};
    }
    if (name == "der" || name == "delay" || formula::is_function(name)) return NameFault{"'" + name + "' is a function", "choose another name"};
    return std::nullopt;
}

bool is_lower_case_name(const std::string& name) {
    const auto fine = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && name.size() <= 60 && name[0] >= 'a' && name[0] <= 'z' && name.back() != '_' &&
           name.find("__") == std::string::npos && std::all_of(name.begin(), name.end(), fine);
}

std::optional<NameFault> fault_of_model_name(const std::string& name) {
    if (!is_lower_case_name(name)) return NameFault{quoted(name) + " is not a model name", "use lower case, digits and single _, a letter first: dc_motor"};
    if (contains(cpp_words, name)) return NameFault{"'" + name + "' is a C++ keyword", "choose another name"};
    if (contains(taken_by_runtime, name)) return NameFault{"'" + name + "' is taken by generated code", "choose another name"};
    return std::nullopt;
}

std::string folded(std::string name) {
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name;
}

std::string class_name(const std::string& model_name) {
    std::string out;
    bool upper = true;
    for (std::size_t k = 0; k < model_name.size(); ++k) {
        const char c = model_name[k];
        const bool before_digit = k + 1 < model_name.size() && std::isdigit(static_cast<unsigned char>(model_name[k + 1])) != 0;
        if (c == '_' && !before_digit) {   // a1 and a_1 are two classes
            upper = true;
        } else {
            out += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
            upper = false;
        }
    }
    return out;
}

std::optional<NameFault> fault_of_prose(const std::string& text) {
    for (const std::string_view mark : {"{{", "}}", "/*", "*/", "?\?/"}) {
        if (text.find(mark) != std::string::npos) {
            return NameFault{"'" + std::string(mark) + "' in a text that goes into generated code", "write it without these characters"};
        }
    }
    if (text.size() > 300) return NameFault{"a text of " + std::to_string(text.size()) + " bytes", "one line of at most 300"};
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
            return NameFault{"a line break or control character in a text that goes into generated code", "write one line"};
        }
    }
    if (!text.empty() && text.back() == '\\') return NameFault{"a text that ends in a backslash", "leave it out"};
    return std::nullopt;
}

}  // namespace algest::model
