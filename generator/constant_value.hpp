// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas of numbers and declared constants: their values, and complaints where they have none.
#pragma once
#include <optional>

#include "generator/formula.hpp"

namespace algest::model {

struct Model;

/// True for 0 and for what is between 10^-exponent and 10^exponent in size.
bool within_power_of_ten(const exact::Rational& value, int exponent);
/// Numbers of a model are: so products and powers of a few of them stay within double.
constexpr int largest_number = 100;

/// The value of a formula of numbers and constants (functions and roots to 60 digits); nullopt: something else is in it, or
/// it has no value.
std::optional<exact::Rational> constant_value(const Model& model, const formula::Formula& f);

/// Complains about every part of a formula that is made of numbers and constants and has no value (x/0, sqrt(-1)) or an
/// unusual one (a power of powers with a million digits), and about exponents beyond formula::largest_exponent, those of powers of powers
/// multiplied. What passes is small enough to compute with. False after a complaint.
bool check_constants(const Model& model, const formula::Formula& f, const formula::Complain& complain);

}  // namespace algest::model
