// SPDX-License-Identifier: GPL-3.0-or-later
// algest keys: what may stand in a model file.
#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "generator/model_keys.hpp"

namespace algest::cli {

namespace {

using model::Key;
using model::KeySection;
using nlohmann::ordered_json;

/// A default as people read it: TOML in backticks, words without their parentheses.
std::string shown_default(const Key& key, const char* quote) {
    const std::string& text = key.by_default;
    if (text.empty()) return text;
    return text.front() == '(' ? text.substr(1, text.size() - 2) : quote + text + quote;
}

std::string as_text(const KeySection& section) {
    std::size_t widest = 0;
    for (const Key& key : section.keys) widest = std::max(widest, key.name.size());
    std::string out = section.heading + "\n";
    for (const Key& key : section.keys) {
        out += fmt::format("  {:<{}}  {}", key.name, widest, key.meaning);
        if (!key.unit.empty()) out += "; unit: " + key.unit;
        if (!key.by_default.empty()) out += "; " + (key.by_default == "(required)" ? "required" : "default: " + shown_default(key, ""));
        out += key.page.empty() ? "\n" : "; docs/" + key.page + "\n";
    }
    return out;
}

std::string as_markdown(const KeySection& section) {
    std::string out = "### `" + section.heading + "`\n\n| key | unit | default | meaning |\n| --- | --- | --- | --- |\n";
    for (const Key& key : section.keys) {
        const std::string page = key.page.empty() ? "" : " ([" + key.page + "](" + key.page + "))";
        out += fmt::format("| `{}` | {} | {} | {}{} |\n", key.name, key.unit, shown_default(key, "`"), key.meaning, page);
    }
    return out;
}

ordered_json as_json(const KeySection& section) {
    ordered_json keys = ordered_json::array();
    for (const Key& key : section.keys) keys.push_back({{"name", key.name}, {"unit", key.unit}, {"default", key.by_default}, {"meaning", key.meaning}, {"page", key.page}});
    return {{"heading", section.heading}, {"keys", std::move(keys)}};
}

}  // namespace

int keys(const KeysOptions& options) {
    ordered_json sections = ordered_json::array();
    std::string text;
    for (const KeySection& section : model::key_sections()) {
        if (options.format == "json") sections.push_back(as_json(section));
        else text += (text.empty() ? "" : "\n") + (options.format == "markdown" ? as_markdown(section) : as_text(section));
    }
    if (options.format == "json") print_json({{"sections", std::move(sections)}});
    else print(text);
    return exit_done;
}

}  // namespace algest::cli
