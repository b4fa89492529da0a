// SPDX-License-Identifier: GPL-3.0-or-later
// Typed access to a TOML file: every value asked for has the right type and range, or a complaint says where and what is right.
#pragma once
#include <toml++/toml.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/exact.hpp"
#include "generator/source_text.hpp"

namespace algest::model {

Position position(const toml::source_region& region);
Position position(const toml::node& node);

/// A text and where it stands.
struct PlacedText {
    std::string text;
    Position at;
};

/// One TOML file and the complaints about it. Readers answer nullopt (tables: null) for a key that is not there, without a
/// complaint, and for a value that is not what is asked for, after one.
class TomlAccess {
public:
    /// Thrown after so many complaints that the rest is left out.
    struct TooMany {};

    /// `text` is the file's, and outlives this.
    TomlAccess(std::string path, const std::string& text, Diagnostics& diagnostics)
        : path_(std::move(path)), text_(text), diagnostics_(diagnostics) {}

    const std::string& path() const { return path_; }
    /// True as long as there was no complaint through this.
    bool sound() const { return complaints_ == 0; }
    Diagnostics& diagnostics() const { return diagnostics_; }

    void error(Position at, std::string what, std::string right);
    void error(const toml::node& node, std::string what, std::string right) { error(position(node), std::move(what), std::move(right)); }
    void warning(Position at, std::string what, std::string right) const { diagnostics_.warning(path_, at, std::move(what), std::move(right)); }

    /// Complains about every key of the table that is none of these.
    void known_keys(const toml::table& table, const std::vector<std::string>& known);

    const toml::table* subtable(const toml::table& table, std::string_view key);
    /// Entries in the order of the file (toml++ keeps them sorted by key); one complaint where there are too many.
    void each_named(const toml::table& table, const std::function<void(const std::string& name, Position at, const toml::node& node)>& use);
    /// The tables of [[key]].
    void each_table(const toml::table& root, std::string_view key, const std::function<void(const toml::table&)>& use);

    std::optional<std::string> string(const toml::table& table, std::string_view key);
    /// The texts of a list; `example` is one that would be right.
    std::vector<PlacedText> strings(const toml::table& table, std::string_view key, const std::string& example);
    std::optional<bool> boolean(const toml::table& table, std::string_view key);
    std::optional<int> whole(const toml::table& table, std::string_view key, int least, int most);
    /// Exact: a float is the shortest decimal that means it, a text a decimal or fraction.
    std::optional<exact::Rational> number(const toml::node& node, const std::string& key);
    std::optional<exact::Rational> number(const toml::table& table, std::string_view key);
    std::optional<exact::Rational> positive(const toml::table& table, std::string_view key);
    std::optional<exact::Rational> not_negative(const toml::table& table, std::string_view key);
    /// A time in seconds, positive.
    std::optional<exact::Rational> duration(const toml::table& table, std::string_view key);
    /// Sets `out` to what stands beside the word; leaves it where the key is not there or its word unknown. `what` the words are: the key
    /// itself, if nothing else is said.
    template <class Value>
    void choose(const toml::table& table, std::string_view key, const std::vector<std::pair<std::string, Value>>& choices, Value& out, std::string_view what = {}) {
        std::vector<std::string> words;
        for (const auto& [word, value] : choices) words.push_back(word);
        if (const auto index = choice(table, key, what.empty() ? key : what, words)) out = choices[*index].second;
    }

    /// The position in the file of every byte of the string that a key holds, and of its end.
    std::vector<Position> places(const toml::node& node, std::size_t value_size) const { return places_of_string(text_, position(node), value_size); }

private:
    bool few_enough(Position at, std::size_t count);
    std::optional<std::size_t> choice(const toml::table& table, std::string_view key, std::string_view what, const std::vector<std::string>& words);

    std::string path_;
    const std::string& text_;
    Diagnostics& diagnostics_;
    int complaints_ = 0;
};

}  // namespace algest::model
