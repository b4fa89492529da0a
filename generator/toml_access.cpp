// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/toml_access.hpp"

#include <algorithm>
#include <cmath>

#include "generator/constant_value.hpp"
#include "generator/suggestion.hpp"

namespace algest::model {

using exact::Rational;

namespace {

constexpr int most_complaints = 100;
constexpr std::size_t most_entries = 100;   // of a table or list, each
constexpr int largest_time = 9;             // 10^+-this, s

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
    return out;
}

}  // namespace

Position position(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}
Position position(const toml::node& node) { return position(node.source()); }

void TomlAccess::error(Position at, std::string what, std::string right) {
    diagnostics_.error(path_, at, std::move(what), std::move(right));
    if (++complaints_ < most_complaints) return;
    diagnostics_.note(path_, "more than " + std::to_string(most_complaints) + " complaints: the rest is left out");
    throw TooMany{};
}

void TomlAccess::known_keys(const toml::table& table, const std::vector<std::string>& known) {
    for (const auto& [key, node] : table) {
        if (std::find(known.begin(), known.end(), std::string(key.str())) == known.end()) {
            error(position(key.source()), "unknown key " + quoted(key.str()), did_you_mean(key.str(), known) + "keys here: " + joined(known, ", "));
        }
    }
}

const toml::table* TomlAccess::subtable(const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) {
        error(*node, "'" + std::string(key) + "' is not a table", "write [" + std::string(key) + "]");
        return nullptr;
    }
    return node->as_table();
}

void TomlAccess::each_named(const toml::table& table, const std::function<void(const std::string&, Position, const toml::node&)>& use) {
    std::vector<std::pair<const toml::key*, const toml::node*>> entries;
    for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        const auto x = a.first->source().begin;
        const auto y = b.first->source().begin;
        return x.line != y.line ? x.line < y.line : x.column < y.column;
    });
    std::size_t count = 0;
    for (const auto& [key, node] : entries) {
        if (!few_enough(position(key->source()), count++)) return;
        use(std::string(key->str()), position(key->source()), *node);
    }
}

/// Too many entries are one complaint, and none of those beyond is looked at.
bool TomlAccess::few_enough(Position at, std::size_t count) {
    if (count < most_entries) return true;
    if (count == most_entries) error(at, "more than " + std::to_string(most_entries) + " entries here", "split the file");
    return false;
}

void TomlAccess::each_table(const toml::table& root, std::string_view key, const std::function<void(const toml::table&)>& use) {
    const toml::node* node = root.get(key);
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    if (array == nullptr) {
        error(*node, "'" + std::string(key) + "' is not an array of tables", "write [[" + std::string(key) + "]]");
        return;
    }
    std::size_t count = 0;
    for (const toml::node& entry : *array) {
        if (!few_enough(position(entry), count++)) return;
        if (entry.is_table()) use(*entry.as_table());
        else error(entry, "'" + std::string(key) + "' holds something that is not a table", "write [[" + std::string(key) + "]]");
    }
}

std::optional<std::string> TomlAccess::string(const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::string>();
    if (!value) error(*node, "'" + std::string(key) + "' is not a text", "write it in quotes");
    return value;
}

std::vector<PlacedText> TomlAccess::strings(const toml::table& table, std::string_view key, const std::string& example) {
    std::vector<PlacedText> out;
    const toml::node* node = table.get(key);
    if (node == nullptr) return out;
    const std::string right = "write " + std::string(key) + " = " + example;
    const toml::array* array = node->as_array();
    if (array == nullptr) {
        error(*node, quoted(key) + " is not a list", right);
        return out;
    }
    for (const toml::node& entry : *array) {
        if (!few_enough(position(entry), out.size())) return out;
        if (auto text = entry.value_exact<std::string>()) out.push_back({std::move(*text), position(entry)});
        else error(entry, quoted(key) + " holds something that is not a text", right);
    }
    return out;
}

std::optional<bool> TomlAccess::boolean(const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<bool>();
    if (!value) error(*node, "'" + std::string(key) + "' is neither true nor false", "write true or false");
    return value;
}

std::optional<int> TomlAccess::whole(const toml::table& table, std::string_view key, int least, int most) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < least || *value > most) {
        error(*node, "'" + std::string(key) + "' is not a whole number from " + std::to_string(least) + " to " + std::to_string(most),
              "write one, without a point");
        return std::nullopt;
    }
    return static_cast<int>(*value);
}

std::optional<Rational> TomlAccess::number(const toml::node& node, const std::string& key) {
    const auto not_a_number = [&] {
        error(node, quoted(key) + " is not a number", "write a decimal or a fraction: 0.1, \"1/3\"");
        return std::nullopt;
    };
    std::optional<Rational> value;
    if (const auto integer = node.value_exact<std::int64_t>()) {
        value = Rational(cln::cl_I(static_cast<long>(*integer)));
    } else if (const auto real = node.value_exact<double>()) {
        if (!std::isfinite(*real)) {
            error(node, quoted(key) + " is not finite", "write a number");
            return std::nullopt;
        }
        value = exact::from_double(*real);
    } else if (const auto text = node.value_exact<std::string>()) {
        value = exact::parse(*text);
    }
    if (!value) return not_a_number();
    if (!within_power_of_ten(*value, largest_number)) {
        const std::string limit = std::to_string(largest_number);
        error(node, quoted(key) + " is beyond 1e" + limit + " or closer to 0 than 1e-" + limit, "choose units in which it is of usual size");
        return std::nullopt;
    }
    return value;
}

std::optional<Rational> TomlAccess::number(const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    return node == nullptr ? std::nullopt : number(*node, std::string(key));
}

std::optional<Rational> TomlAccess::positive(const toml::table& table, std::string_view key) {
    const auto value = number(table, key);
    if (value && !cln::plusp(*value)) {
        error(*table.get(key), "'" + std::string(key) + "' is not positive", "write a number above 0");
        return std::nullopt;
    }
    return value;
}

std::optional<Rational> TomlAccess::not_negative(const toml::table& table, std::string_view key) {
    const auto value = number(table, key);
    if (value && cln::minusp(*value)) {
        error(*table.get(key), "'" + std::string(key) + "' is negative", "write 0 or more");
        return std::nullopt;
    }
    return value;
}

std::optional<Rational> TomlAccess::duration(const toml::table& table, std::string_view key) {
    const auto value = positive(table, key);
    if (value && !within_power_of_ten(*value, largest_time)) {
        const std::string limit = std::to_string(largest_time);
        error(*table.get(key), "'" + std::string(key) + "' is beyond 1e" + limit + " s or below 1e-" + limit + " s", "it is in seconds");
        return std::nullopt;
    }
    return value;
}

std::optional<std::size_t> TomlAccess::choice(const toml::table& table, std::string_view key, std::string_view what, const std::vector<std::string>& words) {
    const auto text = string(table, key);
    if (!text) return std::nullopt;
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    error(*table.get(key), quoted(*text) + " is no " + std::string(what), did_you_mean(*text, words) + std::string(what) + " is one of " + joined(words, " | "));
    return std::nullopt;
}

}  // namespace algest::model
