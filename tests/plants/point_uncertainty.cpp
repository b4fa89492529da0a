// SPDX-License-Identifier: GPL-3.0-or-later
// Standard deviations and biases of operating points, linear least squares and elimination, against the scatter of estimates over many seeds.
#include <fmt/format.h>

#include <cmath>

#include "tests/plants/coverage.hpp"
#include "tests/plants/sensorless_points.hpp"

using namespace algest;
using namespace algest::plants;
using sensorless_motor::OperatingPoint;
using sensorless_motor::operating_points;

namespace {

constexpr unsigned seeds = 400;

/// A model whose declared errors are those of `noisy`: uniform ones have their size over the root of three, and half of `steady` counts.
std::string declared(const std::string& method, double amperes, const std::vector<std::pair<std::string, std::string>>& changes = {}) {
    const bool first = method == first_method;
    const std::string v = first ? "0.02" : "0.2", i = first ? "0.007" : "0.05", true_i = fmt::format("steady = {:.12g} }}\n", 2 * amperes / std::sqrt(3.0));
    return changed(sensorless_text(method, {{", steady = 0.01 }", " }"}, {", steady = " + v + " }\nv_g", " }\nv_g"}, {", steady = " + v + " }\ni_f", " }\ni_f"},
                                            {"steady = " + i + " }\ni_g", true_i + "i_g"}, {"steady = " + i + " }\n\n", true_i + "\n"}}),
                   changes);
}

std::vector<Reported> reports(const plan::Plan& plan, const std::vector<double>& truth, double amperes) {
    std::vector<Reported> out;
    for (const double t : truth) out.push_back({t, {}, {}, {}});
    for (unsigned seed = 0; seed < seeds; ++seed) {
        lab::HostEstimator<double> estimator(plan);
        for (const std::vector<double>& sample : samples(noisy(operating_points(sensorless, 0.2), seed, amperes))) estimator.push(sample.data());
        report(estimator, out);
    }
    return out;
}

/// The deviation of 400 errors scatters by 1/sqrt(800), 3.5 percent; four of them, for there are a dozen parameters. Reported ones are a little large,
/// since what residuals say of the errors counts only where it is more: 1/sqrt(2*88)/sqrt(2 pi), 3 percent. Coverage: 95 percent +- four times 1.1.
void check(const std::string& what, const std::vector<Reported>& all) {
    print(what, all);
    for (const Reported& r : all) {
        INFO(what << ", truth " << r.truth);
        CHECK(r.size() == seeds);
        CHECK(r.ratio() > 1 - 0.14);
        CHECK(r.ratio() < 1.03 + 0.14);
        CHECK(r.coverage() > 0.95 - 0.044);
        // The bias that does not shrink with the number of points; what is left of it is within the mean's own deviation and a twentieth of one estimate's.
        double bias = 0.0;
        for (const double b : r.bias) bias += b / r.size();
        CHECK(std::abs(r.mean_error() - bias) < (4 / std::sqrt(r.size()) + 0.05) * r.empirical_sd());
    }
}

/// The power alone, by linear least squares.
std::string power_alone(double amperes) {
    std::string text = declared(second_method, amperes);
    const std::size_t voltage = text.find("[[equation]]\nname = \"voltage\""), estimator = text.find("[estimator]");
    return changed(text.erase(voltage, estimator - voltage), {{"solve = \"elimination\"\nstages = [\"power\", \"voltage\"]", "solve = \"least_squares\""},
                                                              {"L = { unit = \"H\", initial = 0.01, min = 0 }\n", ""}, {"K = { unit = \"N.m/A\", initial = 0.3, min = 0 }\n", ""}});
}

/// Deviations by changing every current of every point, one after the other, by a millionth of its deviation.
std::vector<double> by_changing_every_mean(const plan::Plan& plan, const std::vector<OperatingPoint>& points, double sd) {
    constexpr double small = 1e-6;
    std::vector<double> squares(plan.parameters.size(), 0.0);
    for (std::size_t k = 0; k < points.size(); ++k) {
        for (double OperatingPoint::*const current : {&OperatingPoint::i_f, &OperatingPoint::i_g}) {
            std::vector<OperatingPoint> up = points, down = points;
            up[k].*current += small * sd;
            down[k].*current -= small * sd;
            const Estimate above = last(plan, up), below = last(plan, down);
            for (std::size_t p = 0; p < squares.size(); ++p) squares[p] += std::pow((above.parameters[p] - below.parameters[p]) / (2 * small), 2);
        }
    }
    for (double& s : squares) s = std::sqrt(s);
    return squares;
}

}  // namespace

TEST_CASE("operating points: deviations are what changing every mean gives, of least squares and elimination in either order") {
    const double amperes = 0.003, sd = amperes / std::sqrt(3.0);
    const std::vector<OperatingPoint> points = operating_points(sensorless, 0.2);
    for (const std::string& text : {declared(second_method, amperes), declared(first_method, amperes), power_alone(amperes)}) {
        const plan::Plan plan = plan_of(text);
        INFO(plan.name << ", " << plan.parameters.size() << " parameters");
        lab::HostEstimator<double> estimator(plan);
        for (const std::vector<double>& sample : samples(points)) (void)estimator.step(sample.data());
        REQUIRE(estimator.uncertainty() == Status::ok);
        const std::vector<double> found = by_changing_every_mean(plan, points, sd);
        // Differences of 1e-6 of a deviation lose the digits that rounding of the first method's R, 1e-12 of it, leaves: four.
        for (std::size_t p = 0; p < found.size(); ++p) CHECK(estimator.deviation()[p] == Approx(found[p]).epsilon(1e-3));
    }
}

TEST_CASE("operating points: deviations of an elimination are the scatter of its estimates, whatever the order of the stages") {
    check("second method", reports(plan_of(declared(second_method, 0.03)), sensorless_truth, 0.03));
    // R shows so little in the voltages that the linear propagation needs small errors.
    check("first method", reports(plan_of(declared(first_method, 0.0005)), sensorless_truth, 0.0005));
}

TEST_CASE("operating points: deviations of linear least squares, of the power alone") {
    const plan::Plan plan = plan_of(power_alone(0.03));
    REQUIRE(plan.solve == Solve::least_squares);
    check("power alone", reports(plan, {sensorless.R, sensorless.f_v, sensorless.C_r}, 0.03));
}

TEST_CASE("operating points: errors that are larger than declared are taken from the residuals") {
    const std::vector<Reported> as_declared = reports(plan_of(declared(second_method, 0.03)), sensorless_truth, 0.03);
    const std::vector<Reported> three_times_better = reports(plan_of(declared(second_method, 0.01)), sensorless_truth, 0.03);
    for (std::size_t p = 0; p < as_declared.size(); ++p) CHECK(three_times_better[p].ratio() == Approx(as_declared[p].ratio()).epsilon(0.2));   // the larger of two stages' residuals
}

TEST_CASE("operating points: a deviation above the limit is singular") {
    const std::vector<OperatingPoint> points = noisy(operating_points(sensorless, 0), 1);
    const plan::Plan plan = plan_of(sensorless_text(second_method));
    lab::HostEstimator<double> unlimited(plan);
    for (const std::vector<double>& sample : samples(points)) (void)unlimited.step(sample.data());
    REQUIRE(unlimited.uncertainty() == Status::ok);
    double largest = 0.0;   // relative to the parameter, or to its initial value if that is larger
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        largest = std::max(largest, unlimited.deviation()[p] / std::max(std::abs(unlimited.parameters()[p]), std::abs(plan.parameters[p].initial)));
    }
    const auto at = [&](double limit) { return last(plan_of(sensorless_text(second_method, {{"stages =", fmt::format("deviation_limit = {:.6g}\nstages =", limit)}})), points).status; };
    CHECK(at(1.001 * largest) == Status::ok);
    CHECK(at(0.999 * largest) == Status::singular);
}
