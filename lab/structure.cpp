// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/structure.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "algest/dot.hpp"
#include "generator/annihilator.hpp"
#include "generator/kernel.hpp"
#include "lab/noise.hpp"
#include "lab/roles.hpp"
#include "lab/spectrum.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr double share_of_structure = 0.15;   ///< of a residual that is foretold: noise does not reach it
constexpr double share_of_a_line = 0.2;       ///< of a residual at one frequency; white noise of 100 windows reaches 0.1
constexpr double bench_tolerance = 1e-7;      ///< of the run whose residual is taken off
constexpr double above_noise = 1.3;           ///< a residual nearer to the noise has no shape to look for
constexpr Eigen::Index windows_a_feature = 2; ///< in the half that a rule is fitted to
constexpr Eigen::Index windows_a_turn = 12;   ///< of a stretch that is fitted, or foretold
constexpr double ridge = 1e-3;                ///< of the features' own power

/// What a residual may hang on, sample by sample: the signals, bent in the usual ways, and their past. The past of a signal that moves
/// starts before the window: its derivative inside the window would tell of the noise of the process itself.
std::vector<std::vector<double>> features(const Variant& v, Rows rows, std::size_t window) {
    std::vector<std::vector<double>> out;
    for (std::size_t s = 0; s < v.bench.measured.size(); ++s) {
        const std::vector<double>& m = v.bench.measured[s];
        if (m.empty()) continue;
        const double size = std::max(size_of(m), 1e-300);
        const auto add = [&](const auto& law, std::size_t lag) {
            std::vector<double> f;
            for (std::size_t row = rows.begin; row < rows.end; ++row) f.push_back(law(m[row >= rows.begin + lag ? row - lag : rows.begin] / size));
            out.push_back(std::move(f));
        };
        const auto same = [](double x) { return x; };
        const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
        add(same, 0);
        add([](double x) { return x * x; }, 0);
        add([](double x) { return x * std::abs(x); }, 0);
        add([](double x) { return x * x * x; }, 0);
        add(sign, 0);
        const bool moves = std::find(v.bench.system.moving.begin(), v.bench.system.moving.end(), static_cast<int>(s)) != v.bench.system.moving.end();
        if (!moves) for (const std::size_t lag : {1, 4, 16, 64}) add(same, lag);
        for (const std::size_t windows : {1, 2, 4}) {   // what remembers, such as hysteresis, shows against the past
            if (moves) add(same, windows * window);
            add(sign, windows * window);
        }
    }
    return out;
}

/// Share of the residual's power that the features explain on stretches that they were not fitted to: stretches take turns, so that no
/// signal that grows leaves the range of the fit, and a ridge holds down what the fit cannot tell.
double foretold(Eigen::MatrixXd X, const Eigen::VectorXd& r) {
    const Eigen::Index windows = r.size();
    if (windows < 2 * windows_a_feature * X.cols() || !(r.squaredNorm() > 0)) return 0;
    for (Eigen::Index f = 0; f < X.cols(); ++f) {
        const double size = X.col(f).norm() / std::sqrt(static_cast<double>(windows));
        if (size > 0) X.col(f) /= size;
    }
    double missed = 0;
    for (const Eigen::Index turn : {0, 1}) {
        Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(X.cols(), X.cols()) * (ridge * static_cast<double>(windows));
        Eigen::VectorXd right = Eigen::VectorXd::Zero(X.cols());
        for (Eigen::Index w = 0; w < windows; ++w) {
            if ((w / windows_a_turn) % 2 == turn) continue;
            normal.noalias() += X.row(w).transpose() * X.row(w);
            right += r[w] * X.row(w).transpose();
        }
        const Eigen::VectorXd rule = normal.ldlt().solve(right);
        for (Eigen::Index w = 0; w < windows; ++w) {
            if ((w / windows_a_turn) % 2 == turn) missed += std::pow(r[w] - X.row(w).dot(rule), 2);
        }
    }
    return 1 - missed / r.squaredNorm();
}

/// Largest share of the residual's power at one frequency.
double strongest_line(const Eigen::VectorXd& r) {
    const auto lines = spectral_lines(r, 1);
    return lines.empty() ? 0 : lines[0].share;
}

/// The recording as the fitted model would have made it: its residual is what sampling alone makes of a model that is right.
/// A run that diverges leaves the recording as it is.
Bench simulated_bench(const Workbench& bench, const Variant& v) {
    Bench out = v.bench;
    const FreeRun run = bench.run(v, bench_tolerance);
    const std::size_t first = bench.parts().fitted.begin;
    if (run.samples + first < bench.parts().train.end) return out;
    for (const int s : v.bench.system.moving) {
        std::vector<double>& m = out.measured[static_cast<std::size_t>(s)];
        if (m.empty()) continue;
        std::copy(run.signals[static_cast<std::size_t>(s)].begin(), run.signals[static_cast<std::size_t>(s)].end(), m.begin() + static_cast<std::ptrdiff_t>(first));
    }
    return out;
}

}  // namespace

bool structured(const Workbench& bench, const Variant& v) {
    const Rows rows = bench.parts().train;
    const Bench simulated = simulated_bench(bench, v);
    for (std::size_t e = 0; e < v.model.equations.size(); ++e) {
        const int n = std::max(moved(v.model, v.model.equations[e]).order, 1);
        for (const int intervals : {16, 64}) {
            const auto form = weak_form(v.model, v.bench, e, rows, intervals);
            if (!form) continue;
            Eigen::VectorXd r = weak_residual(*form, weak_fit(*form, v.fit.parameters).parameters);   // its own: noise of the process in another equation bends the free run's
            const auto of_the_run = weak_form(v.model, simulated, e, rows, intervals);
            if (of_the_run) r -= weak_residual(*of_the_run, v.fit.parameters);
            // At the noise's level the signals' own noise, which both sides share, foretells.
            const double noise = weak_noise(v.model, v.bench, e, rows, intervals, v.fit.parameters, noise_by_signal(v.model, v.bench));
            if (r.norm() < above_noise * noise * std::sqrt(static_cast<double>(r.size()))) continue;
            const auto series = features(v, rows, static_cast<std::size_t>(intervals) + 1);
            const auto weights = kernel::weights(annihilator::kernel(0, 1, {n, 0}), intervals, plan::Hold::linear, plan::Quadrature::exact, plan::Scalar::float64);
            Eigen::MatrixXd X(r.size(), static_cast<Eigen::Index>(series.size()) + 1);
            X.col(0).setOnes();
            for (std::size_t f = 0; f < series.size(); ++f) {
                for (Eigen::Index w = 0; w < r.size(); ++w) {
                    const std::size_t first = form->centre[static_cast<std::size_t>(w)] - rows.begin - static_cast<std::size_t>(intervals + 1) / 2;
                    X(w, static_cast<Eigen::Index>(f) + 1) = dot(weights.data(), series[f].data() + first, intervals + 1);
                }
            }
            if (foretold(X, r) > share_of_structure || strongest_line(r) > share_of_a_line) return true;
        }
    }
    return false;
}

}  // namespace algest::lab
