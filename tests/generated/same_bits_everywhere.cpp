// SPDX-License-Identifier: GPL-3.0-or-later
// Replay and compiled class agree to the last bit whatever the model uses and whoever compiles it: models with every function,
// hold, quadrature and solve, under two compilers and from no optimisation to all of it.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "lab/host_estimator.hpp"
#include "tests/generated/compiled_estimator.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;

namespace {

const std::string head = R"toml(format = 1
[sampling]
period = 1e-3
)toml";

/// Every function of formulas, and powers; a constant beside them.
const std::string functions = "name = \"functions\"\n" + head + R"toml(window = 0.04
[signals]
a = { unit = "1" }
b = { unit = "1" }
c = { unit = "1", hold = "zoh" }
[constants]
half = { value = "1/2", unit = "1" }
w = { value = 0.1, unit = "1" }
[parameters]
p1 = { unit = "s", initial = 1 }
p2 = { unit = "1", initial = -2 }
p3 = { unit = "1", initial = "1/3" }
p4 = { unit = "1" }
[[equation]]
name = "one"
ode = "p1*der(a) + p2*sin(a*w + b)*cos(b) + p3*min(abs(b - a), c)^2 = exp(-a*a)*tan(half*c) + log(1 + b*b)/sqrt(2 + c*c)"
rows = 3
[[equation]]
name = "two"
ode = "p1*der(b) + p4*max(a, b)*sgn(c) - p2*a^3*b/(2 + a^2) = sqrt(abs(a*b*c)) + a^half"
rows = 3
[estimator]
solve = "least_squares"
forgetting = 0.999
)toml";

/// Two derivatives inside nonlinearities, limits, an offset on the constant 1.
const std::string friction = "name = \"friction\"\n" + head + R"toml(window = 0.03
[signals]
q = { unit = "m", min = -3, max = 3 }
x = { unit = "m", max = 3.5 }
force = { unit = "N", hold = "zoh" }
[constants]
slow = { value = 0.1, unit = "m/s" }
[parameters]
M = { unit = "kg", initial = 100 }
Fv = { unit = "N.s/m", initial = 200 }
Fc = { unit = "N", initial = 20 }
offset = { unit = "N" }
[[equation]]
name = "force balance"
ode = "M*der(q,2) + Fv*der(q) + Fc*sgn(der(q))*exp(-abs(der(x))/slow) + offset = force"
rows = 2
[estimator]
solve = "robust"
solve_window = 0.02
)toml";

const std::string perturbed = "name = \"perturbed\"\n" + head + R"toml(window = 0.051
[signals]
y = { unit = "m" }
u = { unit = "N" }
v = { unit = "N", hold = "zoh" }
[transfer]
output = "y"
n = 2
kappa = 2
unknowns = ["a0", "a1"]
[[transfer.input]]
signal = "u"
m = 1
unknowns = ["b0", "b1"]
[[transfer.input]]
signal = "v"
m = 0
unknowns = ["c0"]
)toml";

std::string solved(const std::string& model, const std::string& solve, const std::string& quadrature) {
    std::string out = model;
    if (out.find("[estimator]") == std::string::npos) out += "[estimator]\nsolve = \"" + solve + "\"\n";
    if (solve == "robust" && out.find("solve_window") == std::string::npos) out += "solve_window = 0.017\n";
    return out + "quadrature = \"" + quadrature + "\"\n";
}

/// Smooth and rough, of order one; some outside the limits, some not finite.
template <class S>
std::vector<S> samples(const plan::Plan& plan, int count) {
    std::mt19937_64 random(31);
    std::normal_distribution<double> noise(0.0, 0.02);
    std::vector<S> out;
    const int fill = plan.samples_to_first_estimate();
    for (int k = 0; k < count; ++k) {
        for (std::size_t i = 0; i < plan.inputs.size(); ++i) {
            const double phase = (0.11 + 0.073 * static_cast<double>(i)) * k;
            out.push_back(static_cast<S>(1.2 + std::sin(phase) + 0.4 * std::cos(2.9 * phase) + noise(random)));
        }
        if (k % (2 * fill + 40) == 2 * fill + 30)
            out[out.size() - 1 - random() % plan.inputs.size()] = std::numeric_limits<S>::quiet_NaN();
    }
    return out;
}

template <class S>
void compare(const std::string& model, const std::string& compiler, bool rejects = true) {
    constexpr auto scalar = sizeof(S) == sizeof(double) ? plan::Scalar::float64 : plan::Scalar::float32;
    const plan::Plan plan = plants::plan_of(model, scalar);
    INFO(plan.name << ", " << compiler << ", " << sizeof(S));
    test::CompiledEstimator<S> compiled(plan, compiler);
    lab::HostEstimator<S> host(plan);
    const int count = 8 * plan.samples_to_first_estimate() + 300;
    const std::vector<S> fed = samples<S>(plan, count);
    std::array<int, 4> seen{};
    int uncertain = 0;
    for (int round = 0; round < 2; ++round) {
        for (std::size_t k = 0; k < fed.size(); k += plan.inputs.size()) {
            const std::vector<S> answer = compiled.step(fed.data() + k);
            std::vector<S> wanted{S(static_cast<int>(host.step(fed.data() + k))), host.condition()};
            wanted.insert(wanted.end(), host.parameters().begin(), host.parameters().end());
            REQUIRE(answer.size() == wanted.size());
            REQUIRE(std::memcmp(answer.data(), wanted.data(), answer.size() * sizeof(S)) == 0);
            ++seen[static_cast<std::size_t>(host.status())];
            if (plan.uncertain() && k / plan.inputs.size() % 7 == 0) {
                const std::vector<S> of_class = compiled.uncertainty();
                const Status status = host.uncertainty();
                REQUIRE(of_class[0] == S(static_cast<int>(status)));
                if (status != Status::ok) continue;
                const std::size_t n = static_cast<std::size_t>(plan.estimated());
                std::vector<S> of_host(host.deviation().begin(), host.deviation().begin() + plan.estimated());
                of_host.insert(of_host.end(), host.bias().begin(), host.bias().begin() + plan.estimated());
                REQUIRE(std::memcmp(of_class.data() + 1, of_host.data(), 2 * n * sizeof(S)) == 0);
                ++uncertain;
            }
        }
        compiled.reset();
        host.reset();
    }
    CHECK(seen[static_cast<std::size_t>(Status::ok)] > 100);
    CHECK((seen[static_cast<std::size_t>(Status::rejected)] > 3 || !rejects));
    CHECK((uncertain > 10 || !plan.uncertain()));
}

/// What a desktop, a controller's debug build and an over-eager user would say. All keep -ffp-contract=off.
const std::vector<std::string> compilers{"g++ -O0", "g++ -O3 -march=native", "clang++ -O1",
                                         "clang++ -O3 -march=native -funroll-loops"};

}  // namespace

TEST_CASE("same bits: every function of formulas") {
    for (const std::string& compiler : compilers) {
        compare<double>(functions, compiler);
        compare<float>(functions, compiler);
    }
}

TEST_CASE("same bits: derivatives inside nonlinearities, limits, an offset") {
    for (const std::string& compiler : compilers) {
        compare<double>(friction, compiler);
        compare<float>(friction, compiler);
    }
}

TEST_CASE("same bits: delays by whole samples and by parts, of several signals, in late and in decimated models, with noise") {
    const std::string late = plants::changed(friction, {{"sgn(der(q))*", "sgn(der(q))*delay(x, 0.0035)*"}, {"= force", "= delay(force, 0.002)"}, {"unit = \"N\", initial = 20", "unit = \"N/m\", initial = 20"}});
    const std::string several = plants::changed(functions, {{"cos(b)", "cos(delay(b, 0.0071))"}, {"tan(half*c)", "tan(half*delay(c, 0.001))"}, {"a^3*b", "a^3*delay(b, 4e-4)"}});
    const std::string decimated = plants::changed(several, {{"period = 1e-3", "period = 1e-3\ndecimate = 4"}});
    const std::string noisy = plants::changed(plants::changed(several, {{"b = { unit = \"1\"", "b = { unit = \"1\", noise = 0.01"}, {"rows = 3", "rows = 2"}, {"rows = 3", "rows = 2"}}),
                                              {{"solve = \"least_squares\"\nforgetting = 0.999", "solve = \"square\""}});
    std::size_t turn = 0;
    for (const std::string& text : {late, several, decimated, noisy}) {
        compare<double>(text, compilers[turn++ % compilers.size()]);
        compare<float>(text, compilers[turn++ % compilers.size()]);
    }
}

TEST_CASE("same bits: noise, perturbations, whitened rows, deviation limit, ratio filter, decimation, form 2") {
    const std::vector<std::pair<std::string, std::string>> noisy{{"y = { unit = \"m\" }", "y = { unit = \"m\", noise = 0.01 }"},
                                                                 {"u = { unit = \"N\" }", "u = { unit = \"N\", noise = 0.02 }"},
                                                                 {"kappa = 2", "kappa = 2\nperturbation = \"force\""}};
    const std::string model = plants::changed(perturbed, noisy);
    // initial values: whitening starts from them
    const std::string with_initial = plants::changed(model, {{"[transfer]", "[parameters]\na0 = { initial = 1 }\na1 = { initial = 1 }\nb0 = { initial = 1 }\nb1 = { initial = 1 }\nc0 = { initial = 1 }\n[transfer]"},
                                                             {"kappa = 2", "kappa = 2\nrows = 6"}});
    std::size_t turn = 0;
    for (const std::string& text : {model + "[estimator]\nform = 2\n", model + "[estimator]\ndeviation_limit = 1e6\n", with_initial + "[estimator]\nwhiten = true\n",
                                    model + "[estimator]\nsolve = \"robust\"\nsolve_window = 0.04\nratio_filter = { omega_n = 30 }\n",
                                    plants::changed(model, {{"period = 1e-3", "period = 1e-3\ndecimate = 3"}}) + "[estimator]\nsolve = \"robust\"\nsolve_window = 0.021\n"}) {
        compare<double>(text, compilers[turn++ % compilers.size()]);
        compare<float>(text, compilers[turn++ % compilers.size()]);
    }
}

TEST_CASE("same bits: solves and quadratures") {
    std::size_t turn = 0;
    for (const std::string solve : {"square", "robust", "least_squares"}) {
        for (const std::string quadrature : {"exact", "trapezoid", "simpson"}) {
            // Simpson needs an even number of intervals
            std::string model = perturbed;
            if (quadrature == "simpson") model.replace(model.find("0.051"), 5, "0.052");
            compare<double>(solved(model, solve, quadrature), compilers[turn++ % compilers.size()]);
            compare<float>(solved(model, solve, quadrature), compilers[turn++ % compilers.size()]);
        }
    }
}
