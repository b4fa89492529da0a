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
    std::string neutral = {};      ///< value at which it does nothing: a number, or the name of a parameter or constant; empty: 0
    bool scanned = false;          ///< found by a scan; a constant of the amended model, even where a fit moves it on the way
    bool let_go = false;           ///< the model declares it as a constant
};

/// A hidden state that an amendment brings, with the equation that moves it.
struct NewState {
    std::string name;
    std::string unit;
    double initial;
    std::string equation;    ///< its name
    std::string ode;
};

/// What is done to an equation, or to several.
struct Amendment {
    std::string effect;
    std::vector<std::size_t> equations;   ///< that it is said to enter
    std::vector<std::string> terms;   ///< by equation: "-Tc*sgn(w)", with its sign; empty: none
    std::vector<NewName> names;
    std::string time;        ///< signal that stands for time, where a term needs it and the model has none; else empty
    std::string against;     ///< signal that the terms hang on; empty: none, or more than a signal
    std::string because;     ///< the comment beside the new parameters
    std::vector<Substitution> substitutions = {};
    std::vector<NewState> states = {};
    std::string freed = {};  ///< the constant that is let go
};

/// The amendment that a binding means; names that the model has already get a number. scan: the scanned value, if any.
Amendment amendment(const Binding& binding, const model::Model& model, double scan);

/// Where it enters, as a reader looks for it: the names of the equations, or of the constant that is let go.
std::string place(const Amendment& amendment, const model::Model& model);

/// What it does, on one line: terms, "this -> that", states.
std::string change(const Amendment& amendment);

/// The same effect in the same place, whatever its values.
std::string identity(const Amendment& amendment);

/// The text of the model file with the amendment. A term goes to the end of the side that has no leading derivative, new names behind the
/// last of their table, or into a table of their own at the end of the file, new equations behind the last one. Empty where the text leaves no
/// place for it, or has not the equation that it stands in.
std::string amended(const std::string& text, const model::Model& model, const Amendment& amendment);

/// The text with several amendments in turn, each of a model that has the ones before. path: of the model, for messages. Empty where one of
/// them leaves no model.
std::string amended_in_turn(const std::string& text, const std::string& path, const std::vector<Amendment>& amendments);

}  // namespace algest::lab
