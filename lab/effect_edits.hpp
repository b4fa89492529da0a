// SPDX-License-Identifier: GPL-3.0-or-later
// The edits and states of an effect file: what is replaced by what in which equations.
#pragma once
#include <optional>
#include <set>
#include <string>

#include "generator/toml_access.hpp"
#include "lab/effect.hpp"

namespace algest::lab {

/// The role of a text that is "{role}" and nothing else; nullopt where it is none of the effect's.
std::optional<std::string> role_in_braces(const std::string& text, const Effect& effect);

/// Reads [[edit]], [[state]] and the constant that is let go into an effect whose roles, parameters, scans and names of states are known.
struct EditReading {
    model::TomlAccess& file;
    Effect& effect;
    bool names_known;             ///< else formulas are not looked at
    std::set<std::string> used;   ///< names and {roles} that stand in some formula

    void read(const toml::table& root, const toml::table& rewrite);

private:
    void read_edit(const toml::table& t);
    void read_state(const toml::table& t, EffectState& state);
    std::string role(const toml::table& t, const char* key, const std::string& example);
    std::string formula(const toml::table& t, const char* key, bool needed, const std::string& example);
    void check_formula(const std::string& text, const toml::node& node);
};

}  // namespace algest::lab
