// SPDX-License-Identifier: GPL-3.0-or-later
// The model file of the third-order DC motor with its choices open.
#pragma once
#include <fmt/format.h>

#include <string>

namespace algest::plants {

/// The model of models/ with another window, s, another quadrature, another form of the annihilator.
inline std::string dc_motor_model(double window, const std::string& quadrature = "exact", int form = 1) {
    return fmt::format(R"(format = 1
name = "dc_motor"
[sampling]
period = 1e-3
window = {}
[signals]
y = {{ unit = "rad" }}
u = {{ unit = "V" }}
[transfer]
n = 3
m = 0
unknowns = ["a1", "a2", "b0"]
known = {{ a0 = 0 }}
[estimator]
solve = "square"
quadrature = "{}"
form = {}
)",
                       window, quadrature, form);
}

}  // namespace algest::plants
