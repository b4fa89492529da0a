// SPDX-License-Identifier: GPL-3.0-or-later
// The motor of Delpoux, Bodson, Floquet 2014 without sensors on its shaft: its operating points as samples, with errors, and the two committed models of it.
#pragma once
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "examples/sensorless_motor/equilibrium.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"

namespace algest::plants {

const std::string second_method = "pmsm_sensorless";
const std::string first_method = "pmsm_sensorless_voltage";
constexpr int R = 0, f_v = 1, C_r = 2, L = 3, K = 4;
const sensorless_motor::Motor sensorless;
const std::vector<double> sensorless_truth = {sensorless.R, sensorless.f_v, sensorless.C_r, sensorless.L, sensorless.K};

/// Four samples make a point: what is constant needs no more.
inline std::string sensorless_text(const std::string& model, const std::vector<std::pair<std::string, std::string>>& changes = {}) {
    return changed(changed(committed_model(model), {{"window = 0.2", "window = 4e-3"}}), changes);
}
/// Without the test against errors of the means.
const std::pair<std::string, std::string> untested = {"functional = \"average\"", "functional = \"average\"\nuncertainty = false"};

/// Phase quantities while the commanded angle turns; a point has four samples.
inline std::vector<std::vector<double>> samples(const std::vector<sensorless_motor::OperatingPoint>& points) {
    std::vector<std::vector<double>> out;
    double angle = 0.1;
    for (const sensorless_motor::OperatingPoint& p : points) {
        for (int k = 0; k < 4; ++k, angle += 1e-3 * p.omega) {
            const double c = std::cos(sensorless.n_p * angle), s = std::sin(sensorless.n_p * angle);
            out.push_back({p.v_f * c - p.v_g * s, p.v_f * s + p.v_g * c, p.i_f * c - p.i_g * s, p.i_f * s + p.i_g * c, angle, p.omega});
        }
    }
    return out;
}

/// Uniform errors of both currents and, if asked for, of both voltages.
inline std::vector<sensorless_motor::OperatingPoint> noisy(std::vector<sensorless_motor::OperatingPoint> points, unsigned seed, double amperes = 0.03, double volts = 0.0) {
    std::mt19937 bits(seed);
    const auto error = [&](double most) { return most * (2.0 * static_cast<double>(bits()) / 4294967295.0 - 1.0); };
    for (sensorless_motor::OperatingPoint& p : points) {
        p.i_f += error(amperes);
        p.i_g += error(amperes);
        if (volts == 0.0) continue;
        p.v_f += error(volts);
        p.v_g += error(volts);
    }
    return points;
}

/// Every fourth of the 88 points: one I_max at all 22 speeds.
inline std::vector<sensorless_motor::OperatingPoint> at_one_current(const std::vector<sensorless_motor::OperatingPoint>& all, std::size_t current) {
    std::vector<sensorless_motor::OperatingPoint> out;
    for (std::size_t k = current; k < all.size(); k += 4) out.push_back(all[k]);
    return out;
}

/// What follows from all points; solved once.
inline Estimate last(const plan::Plan& plan, const std::vector<sensorless_motor::OperatingPoint>& points) {
    lab::HostEstimator<double> estimator(plan);
    for (const std::vector<double>& sample : samples(points)) estimator.push(sample.data());
    const Status status = estimator.estimate();
    return {status, estimator.condition(), estimator.parameters()};
}

/// Of one parameter.
inline double sensorless_error(const Estimate& e, int parameter) {
    return relative_error(e.parameters[static_cast<std::size_t>(parameter)], sensorless_truth[static_cast<std::size_t>(parameter)]);
}
/// The largest relative error of R, L, K.
inline double worst_of(const Estimate& e) { return std::max({sensorless_error(e, R), sensorless_error(e, L), sensorless_error(e, K)}); }

}  // namespace algest::plants
