// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

constexpr int lowest = 4;       ///< half waves in the residual
constexpr int refinements = 20; ///< of the distance between two half waves

/// Share of the power at `step` rad a value.
double share_at(const Eigen::VectorXd& r, double step, double power) {
    // The wave by rotation: one product a value instead of two functions.
    const double c1 = std::cos(step);
    const double s1 = std::sin(step);
    double c = 1;
    double s = 0;
    double in_phase = 0;
    double in_quadrature = 0;
    for (Eigen::Index k = 0; k < r.size(); ++k) {
        in_phase += r[k] * c;
        in_quadrature += r[k] * s;
        const double next = c * c1 - s * s1;
        s = s * c1 + c * s1;
        c = next;
    }
    return 2 * (in_phase * in_phase + in_quadrature * in_quadrature) / (static_cast<double>(r.size()) * power);
}

}  // namespace

double line_width(std::size_t samples, double period) { return M_PI / (static_cast<double>(samples) * period); }

std::vector<SpectralLine> spectral_lines(const Eigen::VectorXd& residual, std::size_t most) {
    const double power = residual.squaredNorm();
    if (!(power > 0) || residual.size() < 2 * lowest) return {};
    const double width = M_PI / static_cast<double>(residual.size());
    std::vector<double> share;
    for (int halves = 0; halves < residual.size(); ++halves) share.push_back(halves < lowest ? 0 : share_at(residual, width * halves, power));
    std::vector<std::size_t> peaks;
    for (std::size_t k = lowest; k < share.size(); ++k) {
        if (share[k] >= share[k - 1] && (k + 1 == share.size() || share[k] > share[k + 1])) peaks.push_back(k);
    }
    std::stable_sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
    std::vector<SpectralLine> out;
    for (const std::size_t k : peaks) {
        if (out.size() == most) break;
        const double middle = width * static_cast<double>(k);
        if (std::any_of(out.begin(), out.end(), [&](const SpectralLine& line) { return std::abs(line.step - middle) < 4 * width; })) continue;
        SpectralLine best{middle, share[k]};
        for (int fine = -refinements; fine <= refinements; ++fine) {
            const double step = middle + width * fine / refinements;
            const double here = share_at(residual, step, power);
            if (here > best.share) best = {step, here};
        }
        out.push_back(best);
    }
    return out;
}

}  // namespace algest::lab
