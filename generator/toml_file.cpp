// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/toml_file.hpp"

#include "generator/source_text.hpp"

namespace algest::model {

namespace {

constexpr int longest_key = 10;   // dotted parts; no file needs more than 4

/// toml++ says it of a line end in a string as of any control character.
std::string toml_complaint(const toml::parse_error& e, const std::string& text, Position at) {
    std::string what(e.description());
    for (char& c : what) if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    if (what.find("control characters") != std::string::npos && at_line_end(text, at)) return "a text that is not closed on its line";
    return "not TOML: " + what;
}

}  // namespace

bool read_toml(const std::string& path, const std::string& text, const std::string& see, Diagnostics& diagnostics,
               const std::function<void(const toml::table& root, TomlAccess& file)>& read) {
    if (const auto at = not_utf8(text)) {
        diagnostics.error(path, *at, "not UTF-8", "save the file as UTF-8");
        return false;
    }
    if (const auto at = too_long_key(text, longest_key)) {
        diagnostics.error(path, *at, "a key of more than " + std::to_string(longest_key) + " parts", "no table here is nested so deep");
        return false;
    }
    try {
        const toml::table root = toml::parse(std::string_view(text), path);
        TomlAccess file(path, text, diagnostics);
        if (const toml::node* format = root.get("format")) {
            if (format->value_exact<std::int64_t>() != 1) file.error(*format, "format is not 1", "this version reads format = 1");
        }
        read(root, file);
        return file.sound();
    } catch (const TomlAccess::TooMany&) {
        return false;
    } catch (const toml::parse_error& e) {
        const Position at = within_line(text, position(e.source()));
        diagnostics.error(path, at, toml_complaint(e, text, at), see);
        return false;
    }
}

}  // namespace algest::model
