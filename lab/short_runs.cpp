// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/short_runs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace algest::lab {

namespace {

/// Value, slope and curvature at `at` of a parabola through the samples up to `reach` on both sides, and the rms of what it leaves.
std::pair<Eigen::Vector3d, double> parabola(const std::vector<double>& x, std::size_t at, std::size_t reach, double period) {
    const std::size_t first = at > reach ? at - reach : 0;
    const std::size_t last = std::min(at + reach, x.size() - 1);
    const Eigen::Index count = static_cast<Eigen::Index>(last - first + 1);
    Eigen::MatrixXd basis(count, 3);
    Eigen::VectorXd values(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const double t = (static_cast<double>(first) + static_cast<double>(k) - static_cast<double>(at)) * period;
        basis.row(k) << 1.0, t, 0.5 * t * t;
        values[k] = x[first + static_cast<std::size_t>(k)];
    }
    const Eigen::Vector3d c = basis.colPivHouseholderQr().solve(values);
    const double left = (values - basis * c).norm() / std::sqrt(static_cast<double>(std::max<Eigen::Index>(count - 3, 1)));
    return {c, left};
}

}  // namespace

double roughness(const std::vector<double>& x) {
    if (x.size() < 4) return 0;
    double squares = 0;
    for (std::size_t k = 3; k < x.size(); ++k) {
        const double d = x[k] - 3 * x[k - 1] + 3 * x[k - 2] - x[k - 3];
        squares += d * d;
    }
    return std::sqrt(squares / static_cast<double>(x.size() - 3) / 20.0);
}

std::vector<double> measured_state(const Bench& bench, std::size_t row, const std::vector<double>& otherwise) {
    std::vector<double> out = otherwise;
    for (std::size_t i = 0; i < bench.system.states.size(); ++i) {
        const StateEntry& entry = bench.system.states[i];
        const std::vector<double>& x = bench.measured[static_cast<std::size_t>(entry.signal)];
        if (x.size() < 8 || entry.order > 2) continue;
        // The widest parabola that the noise still lets pass: wider averages more, too wide cuts corners.
        const double noise = roughness(x);
        for (const std::size_t reach : {16, 8, 4}) {
            const auto [c, left] = parabola(x, row, reach, bench.drive.period);
            out[i] = c[entry.order];
            if (left <= 1.5 * noise) break;
        }
    }
    return out;
}

Prediction predict(const Bench& bench, const std::vector<double>& parameters, const std::vector<double>& initial, Rows rows, std::size_t horizon) {
    const std::size_t stride = bench.options.stride;
    Prediction out{std::vector<std::vector<double>>(bench.measured.size()), (rows.size() + stride - 1) / stride};
    RunOptions options = bench.options;
    std::vector<double> start = initial;
    for (std::size_t first = rows.begin; first < rows.end; first += horizon > 0 ? horizon : rows.size()) {
        options.first = first;
        options.end = horizon > 0 ? std::min(first + horizon, rows.end) : rows.end;
        if (horizon > 0) start = measured_state(bench, first, start);
        const FreeRun run = free_run(bench.system, parameters, start, bench.drive, options);
        const std::size_t upto = (options.end - rows.begin + stride - 1) / stride;
        for (std::size_t s = 0; s < run.signals.size(); ++s) {
            if (run.signals[s].empty()) continue;
            out.signals[s].insert(out.signals[s].end(), run.signals[s].begin(), run.signals[s].end());
            out.signals[s].resize(upto, std::numeric_limits<double>::quiet_NaN());
        }
        for (std::size_t i = 0; i < start.size(); ++i) {   // hidden states go on from where the run ended
            const StateEntry& entry = bench.system.states[i];
            if (entry.order == 0 && !run.signals[static_cast<std::size_t>(entry.signal)].empty()) start[i] = run.signals[static_cast<std::size_t>(entry.signal)].back();
        }
    }
    return out;
}

}  // namespace algest::lab
