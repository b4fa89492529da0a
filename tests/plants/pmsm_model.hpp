// SPDX-License-Identifier: GPL-3.0-or-later
// The model file of the PMSM with its choices open, and the plant's samples as its inputs.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/plants/pmsm.hpp"

namespace algest::plants {

/// The model of models/ at 10 kHz. With square, estimates are those of the rows as they are, however uncertain.
inline std::string pmsm_model(const std::string& solve, const std::string& hold = "zoh") {
    return fmt::format(R"(format = 1
name = "pmsm"
[sampling]
period = 1e-4
window = 0.2
[signals]
v_d = {{ unit = "V", hold = "{0}" }}
v_q = {{ unit = "V", hold = "{0}" }}
i_d = {{ unit = "A", noise = 0.0173 }}
i_q = {{ unit = "A", noise = 0.0173 }}
omega = {{ unit = "rad/s" }}
[constants]
n_p = {{ value = 50, unit = "1" }}
[parameters]
R = {{ unit = "ohm", initial = 5 }}
L = {{ unit = "H", initial = 0.03 }}
K = {{ unit = "N.m/A", initial = 0.4 }}
[[equation]]
name = "d axis"
ode = "L*der(i_d) = v_d - R*i_d + n_p*L*omega*i_q"
rows = 2
[[equation]]
name = "q axis"
ode = "L*der(i_q) = v_q - R*i_q - n_p*L*omega*i_d - K*omega"
rows = 1
[estimator]
solve = "{1}"
{2}
)",
                       hold, solve, solve == "robust" ? "solve_window = 0.2" : "deviation_limit = 0");
}

inline std::vector<double> inputs(const PmsmSample& s) { return {s.v_d, s.v_q, s.i_d, s.i_q, s.omega}; }

inline std::vector<std::vector<double>> inputs(const std::vector<PmsmSample>& samples) {
    std::vector<std::vector<double>> out;
    for (const PmsmSample& s : samples) out.push_back(inputs(s));
    return out;
}

}  // namespace algest::plants
