// SPDX-License-Identifier: GPL-3.0-or-later
// Where in the text of an equation something stands that a rewrite replaces.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "generator/model.hpp"

namespace algest::lab {

/// Bytes [begin, end) of an equation's text.
struct Stretch {
    std::size_t begin;
    std::size_t end;
};

/// Every place of a name, those inside der() left out.
std::vector<Stretch> places_of_name(const model::Equation& equation, const std::string& name);

/// Every der() of a signal, of whatever order.
std::vector<Stretch> places_of_derivative(const model::Equation& equation, const std::string& signal);

/// Every difference  a - b  or  b - a  of two signals.
std::vector<Stretch> places_of_difference(const model::Equation& equation, const std::string& a, const std::string& b);

/// Every difference  der(a) - der(b)  or  der(b) - der(a).
std::vector<Stretch> places_of_difference_of_rates(const model::Equation& equation, const std::string& a, const std::string& b);

/// The place of the one parameter or constant that multiplies the highest derivative which the equation moves; empty: there is none, or
/// more than one.
std::vector<Stretch> place_of_leading(const model::Model& model, const model::Equation& equation);

/// Parameters and constants that stand in a product with one signal and nothing else: R of R*i.
std::vector<std::string> factors_of_signal(const model::Model& model, const model::Equation& equation, const std::string& signal);

/// Parameters and constants that multiply the sign of a speed and nothing else: Tc of Tc*sgn(w). The speed is a signal, or its rate.
std::vector<std::string> factors_of_sign(const model::Model& model, const model::Equation& equation, const std::string& signal, bool of_its_rate);

/// Differences of two signals, as pairs of names, each once.
std::vector<std::pair<std::string, std::string>> differences(const model::Model& model, const model::Equation& equation);

}  // namespace algest::lab
