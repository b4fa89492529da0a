// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of a model file: what their readers share, and which file reads which.
#pragma once
#include <map>
#include <set>
#include <string>

#include "generator/model.hpp"
#include "generator/toml_access.hpp"

namespace algest::model {

/// A model file while it is read.
struct Reading {
    TomlAccess& file;
    Model& model;
    bool strict;                                    ///< a missing unit is an error
    std::map<std::string, std::string> names = {};  ///< folded -> as declared
    std::set<std::string> refused_names = {};       ///< declared, but no names
};

// model_quantities.cpp: names, units, limits.
void read_signals(const toml::table& root, Reading& reading);
void read_constants(const toml::table& root, Reading& reading);
void read_parameters(const toml::table& root, Reading& reading);

// model_estimator.cpp: times, rows and solver; needs no other section but [sampling].
void read_sampling(const toml::table& root, Reading& reading);
void read_estimator(const toml::table& root, Reading& reading);

// model_discrete.cpp: [discrete]; after the estimator and the quantities.
void read_discrete(const toml::table& root, Reading& reading);

// model_filter.cpp: [filter], in place of equations; after the signals and [sampling].
void read_filter(const toml::table& root, Reading& reading);

// model_equations.cpp: computed signals, [[equation]] or [transfer], and [[feedback]]; after the quantities that they name.
/// formula = "..." of computed signals.
void read_formulas(const toml::table& root, Reading& reading);
void read_equations(const toml::table& root, Reading& reading);
void read_feedback(const toml::table& root, Reading& reading);

}  // namespace algest::model
