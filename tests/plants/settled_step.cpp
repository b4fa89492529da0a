// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of z and q after a step has settled: what is left in the window is the noise, or the last digit of the samples, and no estimate is made of either.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "lab/discrete_system.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

constexpr double slow = 4.0, fast = 15.0, gain = 3.0;   // 1/s, 1/s, rad/s/V
constexpr double period = 0.01, step_at = 0.5;          // s
constexpr double sensor = 0.03;                         // rad/s: 1 percent of the speed
constexpr int samples_of_run = 800;

std::string model_in(const std::string& domain, const std::string& noise) {
    return fmt::format(R"(format = 1
name = "motor_step"
[sampling]
period = 0.01
window = 1.2
[signals]
u = {{ unit = "V", hold = "zoh" }}
y = {{ unit = "rad/s"{} }}
[discrete]
domain = "{}"
n = 2
numerator = 0
skip = 3
extra = 6
[estimator]
functional = "discrete"
)",
                       noise, domain);
}

/// 1 V from step_at on, and the answer from rest.
std::vector<std::vector<double>> step_response() {
    std::vector<std::vector<double>> out;
    for (int k = 0; k < samples_of_run; ++k) {
        const double t = k * period - step_at;
        out.push_back({t < 0 ? 0.0 : 1.0, t < 0 ? 0.0 : gain * (1.0 - (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow))});
    }
    return out;
}

std::vector<std::vector<double>> noisy(std::vector<std::vector<double>> samples, unsigned seed) {
    std::mt19937 bits(seed);
    std::normal_distribution<double> error(0.0, sensor);
    for (auto& s : samples) s[1] += error(bits);
    return samples;
}

/// As a recording has them, with so many digits.
std::vector<std::vector<double>> printed(std::vector<std::vector<double>> samples, int digits) {
    for (auto& s : samples) s[1] = std::strtod(fmt::format("{:.{}g}", s[1], digits).c_str(), nullptr);
    return samples;
}

/// The larger relative error of the two poles; infinite where they are complex.
double pole_error(const plan::Plan& plan, const std::vector<double>& unknowns) {
    const auto system = lab::discrete_system(plan, unknowns);
    if (!system || system->poles_s.size() != 2) return std::numeric_limits<double>::infinity();
    double out = 0.0;
    for (const std::complex<double>& pole : system->poles_s) out = std::max(out, std::min(std::abs(pole + slow) / slow, std::abs(pole + fast) / fast));
    return out;
}

/// Sample from which on nothing but 1e-4 of the step is in any window: less than a hundredth of the noise. 15/11 exp(-4 t) = 1e-4 at 2.38 s.
const int settled = static_cast<int>((step_at + 2.4 + 1.2) / period) + 1;

}  // namespace

TEST_CASE("settled step: noise alone is singular in z and q, over 200 seeds") {
    for (const std::string domain : {"q", "z"}) {
        const plan::Plan plan = plan_of(model_in(domain, ", noise = 0.03"));
        long ok = 0, all = 0, in_step = 0, of_step = 0;
        for (unsigned seed = 1; seed <= 200; ++seed) {
            const std::vector<Estimate> found = estimates(plan, noisy(step_response(), seed));
            for (std::size_t k = static_cast<std::size_t>(settled); k < found.size(); k += 40) {   // a third of a window apart
                ++all;
                ok += found[k].status == Status::ok ? 1 : 0;
            }
            of_step += 1;
            in_step += found[static_cast<std::size_t>((step_at + 0.9) / period)].status == Status::ok ? 1 : 0;
        }
        fmt::print("{}: {} of {} windows of noise are ok, {} of {} that end 0.9 s after the step\n", domain, ok, all, in_step, of_step);
        // S(t) of noise scatters about its mean like chi squared of one degree or more, and has to be 16 times as large in two directions at once:
        // less than 6e-5 for one of them.
        CHECK(ok == 0);
        CHECK(in_step == of_step);
    }
}

TEST_CASE("settled step: without noise an estimate that is ok has digits left, whatever the samples were printed with") {
    for (const std::string domain : {"q", "z"}) {
        const plan::Plan plan = plan_of(model_in(domain, ""));
        for (const int digits : {17, 12}) {
            const std::vector<Estimate> found = estimates(plan, printed(step_response(), digits));
            double worst = 0.0;
            long ok = 0;
            for (const Estimate& e : found) {
                if (e.status != Status::ok) continue;
                ++ok;
                worst = std::max(worst, pole_error(plan, e.parameters));
            }
            fmt::print("{}, {} digits: {} samples ok, worst pole error {:.2g}\n", domain, digits, ok, worst);
            CHECK(ok > 100);   // the step in the window, at the least
            CHECK(found.back().status == Status::singular);
            // A margin of four deviations leaves a quarter of a direction to the last digit, at the border; one zero that is preset where the held plant
            // has another moves the poles by half a percent at most.
            CHECK(worst < 0.25);
        }
    }
}
