// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/cpp_text.hpp"

#include <cmath>

#include "generator/exact.hpp"

namespace algest::generator {

namespace {

std::string limit_literal(double value, plan::Scalar scalar) {
    if (std::isfinite(value)) return literal(value, scalar);
    return std::string(value < 0 ? "-" : "") + "std::numeric_limits<Scalar>::max()";
}

}  // namespace

std::string scalar_name(plan::Scalar scalar) { return scalar == plan::Scalar::float64 ? "double" : "float"; }
int scalar_bytes(plan::Scalar scalar) { return scalar == plan::Scalar::float64 ? 8 : 4; }

std::string literal(double value, plan::Scalar scalar) { return exact::hexadecimal(value) + (scalar == plan::Scalar::float32 ? "f" : ""); }

std::string unit_text(const std::string& unit) { return unit.empty() ? "unit not declared" : "[" + unit + "]"; }

Data input_data(const plan::Input& input, plan::Scalar scalar) {
    const bool limited = std::isfinite(input.min) || std::isfinite(input.max);
    Data i;
    i.set("name", input.name);
    i.set("unit", unit_text(input.unit));
    i.set("limited", limited);
    i.set("min", std::isfinite(input.min) ? exact::text(exact::from_double(input.min)) : std::string("-inf"));
    i.set("max", std::isfinite(input.max) ? exact::text(exact::from_double(input.max)) : std::string("inf"));
    i.set("accepted", limited ? "within(s." + input.name + ", " + limit_literal(input.min, scalar) + ", " + limit_literal(input.max, scalar) + ")"
                              : "std::isfinite(s." + input.name + ")");
    return i;
}

}  // namespace algest::generator
