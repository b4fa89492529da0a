// SPDX-License-Identifier: GPL-3.0-or-later
// Whether reported standard deviations are right: estimates over many seeds against what uncertainty() says of each.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/plants/changed_model.hpp"
#include "tests/plants/dc_motor.hpp"
#include "tests/plants/estimates.hpp"
#include "tests/plants/magnetic_bearing.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/pmsm_model.hpp"

namespace algest::plants {

/// Estimates of one parameter, each with what was reported of it.
struct Reported {
    double truth;
    std::vector<double> value, sd, bias;

    double size() const { return static_cast<double>(value.size()); }
    double mean_error() const {
        double sum = 0.0;
        for (const double v : value) sum += v - truth;
        return sum / size();
    }
    double empirical_sd() const {
        double sum = 0.0;
        for (const double v : value) sum += std::pow(v - truth - mean_error(), 2);
        return std::sqrt(sum / (size() - 1.0));
    }
    /// Root mean square of the reported ones over the empirical one.
    double ratio() const {
        double sum = 0.0;
        for (const double s : sd) sum += s * s;
        return std::sqrt(sum / size()) / empirical_sd();
    }
    /// Share of the 95 percent intervals, value - bias +- 1.96 sd, that hold the truth.
    double coverage() const {
        double inside = 0.0;
        for (std::size_t k = 0; k < value.size(); ++k) inside += std::abs(value[k] - bias[k] - truth) <= 1.96 * sd[k] ? 1.0 : 0.0;
        return inside / size();
    }
};

/// Solves now, and adds the answer if it is ok.
inline void report(lab::HostEstimator<double>& estimator, std::vector<Reported>& all) {
    if (estimator.estimate() != Status::ok) return;
    REQUIRE(estimator.uncertainty() == Status::ok);
    for (std::size_t p = 0; p < all.size(); ++p) {
        all[p].value.push_back(estimator.parameters()[p]);
        all[p].sd.push_back(estimator.deviation()[p]);
        all[p].bias.push_back(estimator.bias()[p]);
    }
}

inline void print(const std::string& what, const std::vector<Reported>& all) {
    for (const Reported& r : all) {
        double bias = 0.0;
        for (const double b : r.bias) bias += b / r.size();
        fmt::print("{}: {} intervals, {:.1f} percent hold {:.3g}; sd {:.2g}, reported over empirical {:.2f}; mean error {:.1e}, bias reported {:.1e}\n", what, r.value.size(),
                   100.0 * r.coverage(), r.truth, r.empirical_sd(), r.ratio(), r.mean_error(), bias);
    }
}

/// dc_motor, window 2 s read when it first fills, uniform noise of 0.004 rad.
inline std::vector<Reported> dc_motor_reports(unsigned seeds) {
    const plan::Plan plan = plan_of(changed(committed_model("dc_motor"), {{"window = 3 ", "window = 2 "}, {"y = { unit = \"rad\" }", "y = { unit = \"rad\", noise = 0.00230940 }"}}));
    const DcMotor plant;
    const std::vector<DcMotorSample> clean = simulate(plant, 2001);
    std::vector<Reported> all{{plant.a1, {}, {}, {}}, {plant.a2, {}, {}, {}}, {plant.b0, {}, {}, {}}};
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> noise(-0.004, 0.004);   // 0.004/sqrt(3) = 0.0023094
        lab::HostEstimator<double> estimator(plan);
        for (const DcMotorSample& s : clean) estimator.push(std::array<double, 2>{s.y + noise(random), s.u}.data());
        report(estimator, all);
    }
    return all;
}

/// Bearing, kappa = 1, S(t): Gaussian noise of 0.1 um on both positions, which is where the sensors of such bearings are. One instant a seed.
inline std::vector<Reported> bearing_reports(unsigned seeds) {
    const plan::Plan plan = plan_of(changed(committed_model("magnetic_bearing"), {{"Z = { unit = \"m\" }", "Z = { unit = \"m\", noise = 1e-7 }"}, {"Y = { unit = \"m\" }", "Y = { unit = \"m\", noise = 1e-7 }"}}));
    const MagneticBearing bearing;
    const std::vector<BearingSample> clean = simulate(bearing, 1002);
    std::vector<Reported> all;
    for (const double lambda : bearing.lambda) all.push_back({lambda, {}, {}, {}});
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> noise(0.0, 1e-7);
        lab::HostEstimator<double> estimator(plan);
        const std::size_t end = 500 + seed % 500;   // all phases of the ellipse
        for (std::size_t k = end - 420; k <= end; ++k) {
            std::array<double, 5> in{clean[k].Z + noise(random), clean[k].Y + noise(random)};
            for (std::size_t m = 0; m < 3; ++m) in[2 + m] = 0.5 * (clean[k - 1].current[m] * clean[k - 1].current[m] + clean[k].current[m] * clean[k].current[m]);
            estimator.push(in.data());
        }
        report(estimator, all);
    }
    return all;
}

/// PMSM, S(t) at 10 kHz, uniform noise of 0.03 A that the controller sees, four instants a seed, 0.1 s apart from 0.5 s on.
inline std::vector<Reported> pmsm_reports(unsigned seeds) {
    const plan::Plan plan = plan_of(pmsm_model("robust"));
    Pmsm motor;
    motor.current_noise = 0.03;
    std::vector<Reported> all{{motor.R, {}, {}, {}}, {motor.L, {}, {}, {}}, {motor.K, {}, {}, {}}};
    for (motor.seed = 1; motor.seed <= seeds; ++motor.seed) {
        lab::HostEstimator<double> estimator(plan);
        const auto samples = simulate(motor, 8001);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            estimator.push(inputs(samples[k]).data());
            if (k >= 5000 && k % 1000 == 0) report(estimator, all);
        }
    }
    return all;
}

}  // namespace algest::plants
