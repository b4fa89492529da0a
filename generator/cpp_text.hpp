// SPDX-License-Identifier: GPL-3.0-or-later
// What every emitted class writes alike: numbers, units, the members of Sample.
#pragma once
#include <string>

#include "generator/plan.hpp"
#include "generator/render.hpp"

namespace algest::generator {

/// "double" or "float".
std::string scalar_name(plan::Scalar scalar);
int scalar_bytes(plan::Scalar scalar);

/// A literal of the scalar: hexadecimal, exact.
std::string literal(double value, plan::Scalar scalar);

/// "[rad/s]", or that there is none.
std::string unit_text(const std::string& unit);

/// name, unit, limited, min, max, and `accepted`: the test in C++ that a sample `s` of it passes.
Data input_data(const plan::Input& input, plan::Scalar scalar);

}  // namespace algest::generator
