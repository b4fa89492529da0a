// SPDX-License-Identifier: GPL-3.0-or-later
// A term added to a model file as a person would: the text stays as it is, the term and its parameters come in.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "lab/effects.hpp"

namespace algest::lab {

/// A parameter or constant that an amendment brings, as it will be written.
struct NewName {
    std::string name;
    std::string unit;        ///< empty: left out
    double value;            ///< initial value, or the constant's; written no lower than min
    std::optional<double> min;
    bool constant;
};

/// What is added to an equation, or to several.
struct Amendment {
    std::string effect;
    std::vector<std::size_t> equations;
    std::vector<std::string> terms;   ///< by equation: "-Tc*sgn(w)", with its sign
    std::vector<NewName> names;
    std::string time;        ///< signal that stands for time, where a term needs it and the model has none; else empty
    std::string against;     ///< signal that the terms hang on; empty: none, or more than a signal
    std::string because;     ///< the comment beside the new parameters
};

/// The amendment that a binding means; names that the model has already get a number. scan: the scanned value, if any.
Amendment amendment(const Binding& binding, const model::Model& model, double scan);

/// The text of the model file with the amendment. The term goes to the end of the side that has no leading derivative, new names behind the
/// last of their table, or into a table of their own at the end of the file.
std::string amended(const std::string& text, const model::Model& model, const Amendment& amendment);

/// The text with several amendments in turn, each of a model that has the ones before. path: of the model, for messages. Empty where one of
/// them leaves no model.
std::string amended_in_turn(const std::string& text, const std::string& path, const std::vector<Amendment>& amendments);

}  // namespace algest::lab
