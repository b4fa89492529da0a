// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/structure.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "algest/dot.hpp"
#include "lab/noise.hpp"
#include "lab/slope.hpp"
#include "lab/spectrum.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr double share_of_structure = 0.15;   ///< of a residual that is foretold: noise does not reach it
constexpr double share_of_a_line = 0.2;       ///< of a residual at one frequency, at least
constexpr double unlikely = 8;                ///< logarithm of how seldom white noise makes a line where it is called one
constexpr double bench_tolerance = 1e-7;      ///< of the run whose residual is taken off
constexpr double above_noise = 1.3;           ///< a residual nearer to the noise has no shape to look for
constexpr Eigen::Index windows_a_feature = 2; ///< in the half that a rule is fitted to
constexpr Eigen::Index windows_a_turn = 12;   ///< of a stretch that is fitted, or foretold
constexpr double ridge = 1e-3;                ///< of the features' own power

/// A recorded signal, or the slope of one, over its typical size.
struct Series {
    std::vector<double> values;
    bool moves;
};

std::vector<Series> series_of(const Variant& v, const Bench& bench) {
    std::vector<Series> out;
    const std::vector<double> noise = noise_by_signal(v.model, bench);
    const auto add = [&](std::vector<double> values, bool moves) {
        const double size = size_of(values);
        if (!(size > 0)) return;
        for (double& x : values) x /= size;
        out.push_back({std::move(values), moves});
    };
    for (std::size_t s = 0; s < bench.measured.size(); ++s) {
        const std::vector<double>& m = bench.measured[s];
        if (m.empty()) continue;
        const bool own = moves(bench.system, s);
        add(m, own);
        const bool has_speed = std::any_of(bench.system.states.begin(), bench.system.states.end(), [&](const StateEntry& e) { return e.signal == static_cast<int>(s) && e.order == 1; });
        if (has_speed) add(slopes(m, noise[s], bench.drive.period), true);
        for (std::size_t other = 0; other < s && own; ++other) {   // the twist of a shaft, the stroke of a spring between two bodies
            const std::vector<double>& o = bench.measured[other];
            if (o.empty() || v.model.signals[other].unit != v.model.signals[s].unit || v.model.signals[s].unit.empty()) continue;
            std::vector<double> difference = m;
            for (std::size_t row = 0; row < o.size(); ++row) difference[row] -= o[row];
            add(std::move(difference), true);
        }
    }
    return out;
}

/// What a residual may hang on, sample by sample, the plainest first: the signals, bent in the usual ways, and their past. The past of a
/// signal that moves starts before the window: its derivative inside the window would tell of the noise of the process itself.
std::vector<std::vector<double>> features(const std::vector<Series>& series, Rows rows, std::size_t window, std::size_t most) {
    std::vector<std::vector<double>> out;
    const auto add = [&](const Series& s, const auto& law, std::size_t lag) {
        if (out.size() == most) return;
        std::vector<double> f;
        for (std::size_t row = rows.begin; row < rows.end; ++row) f.push_back(law(s.values[row >= rows.begin + lag ? row - lag : rows.begin]));
        out.push_back(std::move(f));
    };
    const auto same = [](double x) { return x; };
    const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
    for (const Series& s : series) add(s, same, 0);
    for (const Series& s : series) add(s, [](double x) { return x * x * x; }, 0);
    for (const Series& s : series) add(s, sign, 0);
    for (const Series& s : series) add(s, [](double x) { return x * x; }, 0);
    for (const std::size_t lag : {1U, 4U, 16U, 64U}) for (const Series& s : series) if (!s.moves) add(s, same, lag);
    for (const std::size_t windows : {1U, 2U, 4U}) {   // what remembers, such as hysteresis, shows against the past
        for (const Series& s : series) {
            if (s.moves) add(s, same, windows * window);
            add(s, sign, windows * window);
        }
    }
    for (const Series& s : series) add(s, [](double x) { return x * std::abs(x); }, 0);
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

/// White noise of n values has a line of share z with probability exp(-z n/2), and there are n of them.
double line_threshold(Eigen::Index values) {
    const double n = static_cast<double>(values);
    return std::max(share_of_a_line, 2 * (std::log(n) + unlikely) / n);
}

/// The recording as the fitted model would have made it: its residual is what sampling alone makes of a model that is right.
/// A run that diverges leaves the recording as it is.
Bench simulated_bench(const Workbench& bench, const Variant& v, std::size_t recording) {
    Bench out = bench_of(v, recording);
    const FreeRun run = bench.run(v, bench_tolerance, recording);
    if (run.samples < bench.parts(recording).train.end) return out;
    for (const int s : simulated_signals(out.system)) {
        std::vector<double>& m = out.measured[static_cast<std::size_t>(s)];
        if (m.empty()) continue;
        std::copy(run.signals[static_cast<std::size_t>(s)].begin(), run.signals[static_cast<std::size_t>(s)].end(), m.begin());
    }
    return out;
}

bool structured(const Workbench& bench, const Variant& v, std::size_t recording) {
    const Rows rows = bench.parts(recording).train;
    const Bench& recorded = bench_of(v, recording);
    const Bench simulated = simulated_bench(bench, v, recording);
    const std::vector<Series> series = series_of(v, recorded);
    for (std::size_t e = 0; e < v.model.equations.size(); ++e) {
        for (const int intervals : weak_intervals(rows)) {
            const auto form = weak_form(v.model, recorded, e, rows, intervals);
            if (!form) continue;
            Eigen::VectorXd r = weak_residual(*form, weak_fit(*form, v.fit.parameters).parameters);   // its own: noise of the process in another equation bends the free run's
            const auto of_the_run = weak_form(v.model, simulated, e, rows, intervals);
            if (of_the_run) r -= weak_residual(*of_the_run, v.fit.parameters);
            // At the noise's level the signals' own noise, which both sides share, foretells.
            const double noise = weak_noise(v.model, recorded, e, rows, intervals, v.fit.parameters, noise_by_signal(v.model, recorded));
            if (r.norm() < above_noise * noise * std::sqrt(static_cast<double>(r.size()))) continue;
            const auto candidates = features(series, rows, static_cast<std::size_t>(intervals) + 1, static_cast<std::size_t>(std::max<Eigen::Index>(r.size() / (2 * windows_a_feature), 1)) - 1);
            const auto weights = row_weights(v.model, e, intervals);
            Eigen::MatrixXd X(r.size(), static_cast<Eigen::Index>(candidates.size()) + 1);
            X.col(0).setOnes();
            for (std::size_t f = 0; f < candidates.size(); ++f) {
                for (Eigen::Index w = 0; w < r.size(); ++w) {
                    const std::size_t first = form->centre[static_cast<std::size_t>(w)] - rows.begin - static_cast<std::size_t>(intervals + 1) / 2;
                    X(w, static_cast<Eigen::Index>(f) + 1) = dot(weights.data(), candidates[f].data() + first, intervals + 1);
                }
            }
            if (foretold(X, r) > share_of_structure || strongest_line(r) > line_threshold(r.size())) return true;
        }
    }
    return false;
}

}  // namespace

bool structured(const Workbench& bench, const Variant& v) {
    for (std::size_t r = 0; r < bench.recordings(); ++r) if (structured(bench, v, r)) return true;
    return false;
}

}  // namespace algest::lab
