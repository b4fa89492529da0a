// SPDX-License-Identifier: 0BSD
// The controller of section VI-B, built from what was identified: R = H N1 N2, a PI part and a notch for each pair of poles.
#pragma once
#include <algorithm>
#include <complex>
#include <optional>
#include <vector>

#include "transfer.hpp"

namespace drive_train {

/// 1 + 2 xi q/omega + (q/omega)^2
struct Pair {
    double omega;   ///< rad/s
    double xi;
};

/// The pairs of complex poles, the slow one first.
inline std::vector<Pair> pairs_of(const Transfer& of) {
    std::vector<Pair> out;
    for (const std::complex<double> q : roots(of.denominator)) {
        if (q.imag() > 0.0) out.push_back({std::abs(q), -q.real() / std::abs(q)});
    }
    std::sort(out.begin(), out.end(), [](const Pair& a, const Pair& b) { return a.omega < b.omega; });
    return out;
}

inline Transfer notch(const Pair& pair, double kept_xi) {
    const double w = pair.omega;
    return {{1.0, 2.0 * kept_xi / w, 1.0 / (w * w)}, {1.0, 2.0 / w, 1.0 / (w * w)}, 0};
}

struct Design {
    Transfer pi{{0.08, 0.008}, {0.0, 1.0}, 0};   ///< H = 0.08 (1 + q/10)/q
    std::vector<Transfer> notches;               ///< N1, N2
};

/// The slow pair is cancelled as it was found, the fast one with 1.5 times its damping; nullopt unless there are two stable pairs.
inline std::optional<Design> design(const Transfer& identified) {
    const std::vector<Pair> pairs = pairs_of(identified);
    if (pairs.size() != 2 || pairs[0].xi <= 0.0 || pairs[1].xi <= 0.0) return std::nullopt;
    Design out;
    out.notches = {notch(pairs[0], pairs[0].xi), notch(pairs[1], 1.5 * pairs[1].xi)};
    return out;
}

class Controller {
public:
    Controller(const Design& design, bool with_notches, double period) {
        filters_.emplace_back(design.pi, period);
        if (with_notches) for (const Transfer& n : design.notches) filters_.emplace_back(n, period);
    }

    /// The voltage [V] for the coming period.
    double command(double wanted, double omega) {
        double x = wanted - omega;
        for (Filter& f : filters_) x = f.step(x);
        return x;
    }

private:
    std::vector<Filter> filters_;
};

}  // namespace drive_train
