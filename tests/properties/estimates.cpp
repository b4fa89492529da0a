// SPDX-License-Identifier: GPL-3.0-or-later
// For any samples: an estimate is that of its window, wherever in the recording the window lies; and other units of the same quantities give the
// same physical estimates.
#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/plants/estimates.hpp"
#include "tests/plants/pmsm_model.hpp"
#include "tests/properties/rows_of.hpp"

using namespace algest;
using namespace algest::plants;
using namespace algest::properties;

namespace {

using Samples = std::vector<std::vector<double>>;   ///< one a row

Samples any_samples(int count) {
    const auto v = whole_numbers(count, 100), i = whole_numbers(count, 100);
    Samples out;
    for (std::size_t k = 0; k < v.size(); ++k) out.push_back({v[k], i[k]});
    return out;
}

plan::Plan rl_plan(const std::string& estimator) {
    return plan_of(fmt::format(R"(format = 1
name = "rl"
[sampling]
period = 0.01
window = "{}/100"
[signals]
v = {{ unit = "V", hold = "zoh" }}
i = {{ unit = "A" }}
[parameters]
R = {{ unit = "ohm", initial = 1 }}
L = {{ unit = "H", initial = 1 }}
[[equation]]
name = "voltage balance"
ode = "L*der(i) = v - R*i"
[estimator]
{}
)",
                               *rc::gen::inRange(12, 41), estimator));
}

/// What stands before a unit for 10^exponent.
const std::map<int, std::string> prefix = {{-6, "u"}, {-3, "m"}, {0, ""}, {3, "k"}, {6, "M"}};

/// The motor with voltages in 10^volt V and currents in 10^ampere A, everything else in what goes with them.
std::string motor(int volt, int ampere, const std::string& estimator) {
    return fmt::format(R"(format = 1
name = "pmsm"
[sampling]
period = 1e-4
window = 0.03
[signals]
v_d = {{ unit = "{0}V", hold = "zoh" }}
v_q = {{ unit = "{0}V", hold = "zoh" }}
i_d = {{ unit = "{1}A", noise = {3} }}
i_q = {{ unit = "{1}A", noise = {3} }}
omega = {{ unit = "rad/s" }}
[constants]
n_p = {{ value = 50, unit = "1" }}
[parameters]
R = {{ unit = "{2}ohm", initial = {4} }}
L = {{ unit = "{2}H", initial = {5} }}
K = {{ unit = "{0}V.s", initial = {6} }}
[[equation]]
name = "d axis"
ode = "L*der(i_d) = v_d - R*i_d + n_p*L*omega*i_q"
rows = 2
[[equation]]
name = "q axis"
ode = "L*der(i_q) = v_q - R*i_q - n_p*L*omega*i_d - K*omega"
rows = 1
[estimator]
{7}
)",
                       prefix.at(volt), prefix.at(ampere), prefix.at(volt - ampere), 0.0173 * std::pow(10.0, -ampere), 5 * std::pow(10.0, ampere - volt),
                       0.03 * std::pow(10.0, ampere - volt), 0.4 * std::pow(10.0, -volt), estimator);
}

}  // namespace

TEST_CASE("properties of estimates: the window may lie anywhere") {
    rc::prop("of the same samples later on, to the last bit, with tables", [] {
        const plan::Plan plan = rl_plan("solve = \"square\"");
        const Samples samples = any_samples(plan.samples() + 5);
        Samples later = any_samples(*rc::gen::inRange(1, 2 * plan.samples()));
        const std::size_t shift = later.size();
        later.insert(later.end(), samples.begin(), samples.end());
        const auto first = estimates(plan, samples), second = estimates(plan, later);
        for (std::size_t k = static_cast<std::size_t>(plan.intervals); k < samples.size(); ++k) {
            RC_ASSERT(first[k].status == second[k + shift].status);
            RC_ASSERT(first[k].condition == second[k + shift].condition);
            if (first[k].status == Status::ok) RC_ASSERT(first[k].parameters == second[k + shift].parameters);
        }
    });
    rc::prop("within rounding, where sums are carried along", [] {
        const std::string engine = *rc::gen::element<std::string>("fir", "moments");
        const plan::Plan plan = rl_plan(fmt::format("solve = \"robust\"\nsolve_window = 0.2\nengine = \"{}\"", engine));
        const Samples samples = any_samples(plan.samples_to_first_estimate() + 5);
        Samples later = any_samples(*rc::gen::inRange(1, 2 * plan.samples()));
        const std::size_t shift = later.size();
        later.insert(later.end(), samples.begin(), samples.end());
        const auto first = estimates(plan, samples), second = estimates(plan, later);
        for (std::size_t k = static_cast<std::size_t>(plan.samples_to_first_estimate() - 1); k < samples.size(); ++k) {
            RC_ASSERT(first[k].status == second[k + shift].status);
            if (first[k].status != Status::ok) continue;
            for (std::size_t p = 0; p < 2; ++p) {
                const double size = std::abs(first[k].parameters[0]) + std::abs(first[k].parameters[1]);
                // moments are right to 1e-11 of the largest output (tests/runtime/moments.cpp), which the condition multiplies; R and L pass through a quotient
                RC_ASSERT(std::abs(first[k].parameters[p] - second[k + shift].parameters[p]) <= 1e-10 * first[k].condition * (size + size * size));
            }
        }
    });
}

TEST_CASE("properties of estimates: units do not matter") {
    static const std::vector<PmsmSample> run = [] {
        Pmsm plant;
        plant.current_noise = 0.03;
        return simulate(plant, 2000);
    }();
    rc::prop("volts and amperes with any prefix", [] {
        const int volt = 3 * *rc::gen::inRange(-1, 2), ampere = 3 * *rc::gen::inRange(-1, 2);
        const std::string estimator = *rc::gen::element<std::string>("solve = \"square\"\ndeviation_limit = 0", "solve = \"robust\"\nsolve_window = 0.02",
                                                                     "solve = \"least_squares\"", "solve = \"robust\"\nsolve_window = 0.02\nengine = \"moments\"");
        const auto from = static_cast<std::ptrdiff_t>(*rc::gen::inRange(0, 1300));
        const std::vector<PmsmSample> some(run.begin() + from, run.begin() + from + 600);
        Samples in_si, in_others;
        for (const PmsmSample& s : some) {
            in_si.push_back(inputs(s));
            in_others.push_back(inputs(s));
            for (std::size_t i = 0; i < 4; ++i) in_others.back()[i] *= std::pow(10.0, i < 2 ? -volt : -ampere);
        }
        const auto si = estimates(plan_of(motor(0, 0, estimator)), in_si), others = estimates(plan_of(motor(volt, ampere, estimator)), in_others);
        const double unit[] = {std::pow(10.0, volt - ampere), std::pow(10.0, volt - ampere), std::pow(10.0, volt)};
        std::size_t compared = 0;
        for (std::size_t k = 0; k < si.size(); ++k) {
            RC_ASSERT(si[k].status == others[k].status);
            if (si[k].status != Status::ok) continue;
            ++compared;
            for (std::size_t p = 0; p < 3; ++p) {
                // rows of 300 products, each rounded anew in other units: 300 epsilon, times the condition, and 10 for the map to R, L, K
                const double bound = 3000 * std::numeric_limits<double>::epsilon() * si[k].condition;
                RC_ASSERT(relative_error(others[k].parameters[p] * unit[p], si[k].parameters[p]) < bound);
            }
        }
        RC_ASSERT(compared >= 100);   // S(t) is filled after 500 of the 600 samples; a square solve is not held back by its deviations
    });
}
