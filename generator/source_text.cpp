// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/source_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace algest::model {

std::optional<std::string> read_text(const std::string& path, std::size_t limit, Diagnostics& diagnostics) {
    std::error_code error;
    const auto kind = std::filesystem::status(path, error).type();
    if (kind == std::filesystem::file_type::not_found) {
        diagnostics.error(path, {}, "no such file", "check the path");
        return std::nullopt;
    }
    if (kind == std::filesystem::file_type::directory) {
        diagnostics.error(path, {}, "is a directory", "name a file");
        return std::nullopt;
    }
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        diagnostics.error(path, {}, std::string("cannot be read: ") + std::strerror(errno), "check its permissions");
        return std::nullopt;
    }
    std::string text(limit + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > limit) {
        diagnostics.error(path, {}, "larger than " + std::to_string(limit / 1024) + " KiB, so not a model file", "name a model file");
        return std::nullopt;
    }
    return text;
}

namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Walks through a text, counting lines and characters.
struct Walker {
    const std::string& text;
    std::size_t at = 0;
    Position place{1, 1};

    char peek(std::size_t ahead = 0) const { return at + ahead < text.size() ? text[at + ahead] : '\0'; }
    bool looking_at(const char* mark) const { return text.compare(at, std::strlen(mark), mark) == 0; }
    void step() {
        if (at >= text.size()) return;
        const char c = text[at++];
        if (c == '\n') {
            ++place.line;
            place.column = 1;
        } else if (at >= text.size() || !is_continuation(text[at])) {
            ++place.column;
        }
    }
    void skip_byte_order_mark() { if (looking_at("\xEF\xBB\xBF")) at = 3; }
    void steps(int count) { for (int i = 0; i < count; ++i) step(); }
};

/// Bytes of the value that the escape at the walker stands for; moves behind it.
std::size_t skip_escape(Walker& w) {
    w.step();
    const char kind = w.peek();
    if (kind != 'u' && kind != 'U') {
        w.step();
        return 1;
    }
    const int digits = kind == 'u' ? 4 : 8;
    const unsigned long code = std::strtoul(w.text.substr(w.at + 1, static_cast<std::size_t>(digits)).c_str(), nullptr, 16);
    w.steps(1 + digits);
    return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
}

/// Moves behind the string that starts at the walker; behind its line where it is not closed.
void skip_string(Walker& w) {
    const char quote = w.peek();
    const bool multiline = w.peek(1) == quote && w.peek(2) == quote;
    w.steps(multiline ? 3 : 1);
    while (w.at < w.text.size()) {
        if (quote == '"' && w.peek() == '\\') {
            w.steps(2);
        } else if (w.peek() == quote && (!multiline || (w.peek(1) == quote && w.peek(2) == quote))) {
            w.steps(multiline ? 3 : 1);
            while (multiline && w.peek() == quote) w.step();   // """a"""" ends in a quote of its own
            return;
        } else if (!multiline && w.peek() == '\n') {
            return;
        } else {
            w.step();
        }
    }
}

}  // namespace

std::optional<Position> not_utf8(const std::string& text) {
    Walker w{text};
    w.skip_byte_order_mark();
    Position place{1, 1};   // the walker counts a stray continuation byte as a part of the character before
    while (w.at < text.size()) {
        const unsigned char first = static_cast<unsigned char>(text[w.at]);
        const std::size_t size = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
        const unsigned char second = static_cast<unsigned char>(w.peek(1));
        const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
        const bool beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);   // surrogates, U+110000
        bool good = size > 0 && !overlong && !beyond;
        for (std::size_t k = 1; k < size; ++k) good = good && is_continuation(w.peek(k));
        if (!good) return place;
        for (std::size_t k = 0; k < size; ++k) w.step();
        place = first == '\n' ? Position{place.line + 1, 1} : Position{place.line, place.column + 1};
    }
    return std::nullopt;
}

std::optional<Position> too_long_key(const std::string& text, int limit) {
    Walker w{text};
    w.skip_byte_order_mark();
    int parts = 1;
    while (w.at < text.size()) {
        const char c = w.peek();
        if (c == '#') {
            while (w.at < text.size() && w.peek() != '\n') w.step();
        } else if (c == '"' || c == '\'') {
            skip_string(w);
            continue;
        } else if (c == '.') {
            if (++parts > limit) return w.place;
        } else if (c == '=' || c == ',' || c == '{' || c == '[' || c == ']' || c == '\n') {
            parts = 1;
        }
        w.step();
    }
    return std::nullopt;
}

namespace {
/// A walker at a place, or at the end of its line.
Walker walker_at(const std::string& text, Position at) {
    Walker w{text};
    w.skip_byte_order_mark();
    while (w.at < text.size() && w.place.line < at.line) w.step();
    while (w.at < text.size() && w.place.column < at.column && w.peek() != '\n' && w.peek() != '\r') w.step();
    return w;
}
}  // namespace

Position within_line(const std::string& text, Position at) { return walker_at(text, at).place; }

bool at_line_end(const std::string& text, Position at) {
    const Walker w = walker_at(text, at);
    return w.at >= text.size() || w.peek() == '\n' || w.peek() == '\r';
}

std::vector<Position> places_of_string(const std::string& file_text, Position start, std::size_t value_size) {
    Walker w{file_text};
    w.skip_byte_order_mark();
    while (w.at < file_text.size() && (w.place.line < start.line || (w.place.line == start.line && w.place.column < start.column))) w.step();

    const char quote = w.peek();
    const bool basic = quote == '"';
    const bool multiline = w.peek(1) == quote && w.peek(2) == quote;
    w.steps(multiline ? 3 : 1);
    if (multiline && w.peek() == '\r') w.step();
    if (multiline && w.peek() == '\n') w.step();

    std::vector<Position> places;
    while (places.size() < value_size && w.at < file_text.size()) {
        const Position here = w.place;
        if (basic && w.peek() == '\\') {
            const char next = w.peek(1);
            if (multiline && (next == '\n' || next == '\r' || next == ' ' || next == '\t')) {   // line-ending backslash
                w.step();
                while (w.peek() == ' ' || w.peek() == '\t' || w.peek() == '\n' || w.peek() == '\r') w.step();
                continue;
            }
            places.insert(places.end(), skip_escape(w), here);
            continue;
        }
        if (multiline && w.peek() == '\r' && w.peek(1) == '\n') w.step();   // CRLF is LF in the value
        places.push_back(here);
        w.step();
    }
    places.resize(value_size, w.place);
    places.push_back(w.place);
    return places;
}

}  // namespace algest::model
