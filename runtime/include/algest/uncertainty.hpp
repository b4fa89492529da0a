// SPDX-License-Identifier: MIT-0
// What the sensors' noise does to an estimate: covariance by the delta method through the known weights, errors of the regressors included,
// and the bias that noisy regressors cause.
//
// Stack the rows of all instants that were solved with: P theta = Q, solved as theta = P+ Q. With e = P theta - Q, zero without noise,
//     theta^ - theta = -P+ de + P+ dP P+ de - (P'P)^-1 dP' (I - P P+) de + ...                          (perturbation of the pseudoinverse)
// The first term is linear in the noise: raw sample k of signal s reaches it by one total influence over all windows that hold it, so that the
// overlap of the windows of S(t) is in it. The other two are quadratic; their expectation is the bias. Noise that comes back through a
// controller into the true signals is no error of the rows: neither counts it.
#pragma once
#include <cmath>

#include "algest/noise.hpp"
#include "algest/packed.hpp"
#include "algest/solve_gram.hpp"
#include "algest/solve_rows.hpp"
#include "algest/whitening.hpp"

namespace algest {

/// Instants of S(t) that stand for all of them: each for a block around it (midpoint rule; the rows move smoothly, for windows are long
/// against blocks).
constexpr int most_nodes = 32;
constexpr int node_stride(int instants) noexcept { return instants < 1 ? 1 : (instants + most_nodes - 1) / most_nodes; }
constexpr int node_count(int instants) noexcept { return instants < 1 ? 1 : (instants + node_stride(instants) - 1) / node_stride(instants); }

/// One instant that was solved with: where its window starts, counted from the oldest sample of all windows, and how many it stands for.
struct Node {
    int start;
    int instants;
};
constexpr Node node(int index, int instants) noexcept {
    if (instants < 1) return {0, 1};
    const int first = index * node_stride(instants);   // counted from the newest instant back
    const int left = instants - first;
    const int size = left < node_stride(instants) ? left : node_stride(instants);
    return {instants - 1 - first - (size - 1) / 2, size};
}

/// The rows that an estimate was solved with, and how it moves with each of them.
template <class S>
struct Influence {
    const S* rows;      ///< by node: [P|Q] of its window (whitened, if the solve whitens), rows x (unknowns+1)
    const S* gain;      ///< by node: d theta / d Q, times the node's instants: unknowns x rows
    const S* inverse;   ///< (P'P)^-1 of all instants, unknowns x unknowns; nullptr: one square instant, where nothing of it is needed
    const S* factor;    ///< Cholesky factor that whitens the rows; nullptr: none
};

/// Scalars of scratch that propagate_noise needs.
constexpr int propagate_scratch(int rows, int unknowns) noexcept { return (rows + unknowns) * (unknowns + 1) + 3 * unknowns; }

/// covariance (packed upper triangle of unknowns x unknowns) and, unless nullptr, bias (unknowns) of theta. instants: of S(t); 0: the newest
/// alone. oldest: position of the oldest sample of all windows. Cost: (samples + instants) x noisy signals x nodes whose window holds the
/// sample (at most 32) x (noise_in_rows + rows unknowns (unknowns+1), with a bias 3 rows unknowns more). Never fails; what is not finite passes through.
template <class S>
inline void propagate_noise(const RowSet<S>& set, const Noise<S>& noise, const S* rings, WindowPosition oldest, int instants, const Influence<S>& by,
                            const S* theta, S* scratch, S* covariance, S* bias) noexcept {
    const int n = set.unknowns;
    const int width = n + 1;
    S* change = scratch;                    // of the rows of one node
    S* reach = change + set.rows * width;   // P+ dP, and P+ dQ in the last column
    S* shift = reach + n * width;           // -P+ de
    S* normal = shift + n;                  // P' de
    S* pending = normal + n;                // what (P'P)^-1 is still to be applied to
    for (int i = 0; i < packed_size(n); ++i) covariance[i] = S(0);
    if (bias != nullptr) {
        for (int u = 0; u < n; ++u) bias[u] = pending[u] = S(0);
    }
    const int span = set.samples + (instants < 1 ? 0 : instants - 1);
    const int before = largest_lag(noise);
    for (int k = -before; k < span; ++k) {
        for (int s = 0; s < noise.inputs; ++s) {
            for (int i = 0; i < n * width; ++i) reach[i] = S(0);
            for (int u = 0; u < n; ++u) normal[u] = S(0);
            for (int m = 0; m < node_count(instants); ++m) {
                const Node at = node(m, instants);
                const int sample = k - at.start;
                if (sample < -before || sample >= set.samples) continue;
                const int start = oldest.start + at.start;
                noise_in_rows(set, noise, rings, WindowPosition{oldest.length, start >= oldest.length ? start - oldest.length : start}, s, sample, change);
                if (by.factor != nullptr) whiten(by.factor, change, set.rows, width);
                const S* rows = by.rows + m * set.rows * width;
                const S* gain = by.gain + m * n * set.rows;
                for (int r = 0; r < set.rows; ++r) {
                    const S* row = change + r * width;
                    for (int u = 0; u < n; ++u) {
                        for (int c = 0; c < width; ++c) reach[u * width + c] += gain[u * set.rows + r] * row[c];
                    }
                    if (bias == nullptr || by.inverse == nullptr) continue;
                    const S error = S(at.instants) * residual(row, theta, n);
                    for (int c = 0; c < n; ++c) {
                        normal[c] += rows[r * width + c] * error;
                        pending[c] += row[c] * error;
                    }
                }
            }
            for (int u = 0; u < n; ++u) shift[u] = -residual(reach + u * width, theta, n);
            int entry = 0;
            for (int u = 0; u < n; ++u) {
                for (int v = u; v < n; ++v, ++entry) covariance[entry] += shift[u] * shift[v];
            }
            if (bias == nullptr) continue;
            for (int u = 0; u < n; ++u) {
                for (int c = 0; c < n; ++c) {
                    bias[u] -= reach[u * width + c] * shift[c];
                    if (by.inverse != nullptr) pending[c] -= reach[u * width + c] * normal[u];
                }
            }
        }
    }
    if (bias == nullptr || by.inverse == nullptr) return;
    for (int u = 0; u < n; ++u) {
        for (int c = 0; c < n; ++c) bias[u] -= by.inverse[u * n + c] * pending[c];
    }
}

/// Standard deviation of a function of theta: sqrt(g' C g), g its gradient. Cost: n^2 operations.
template <class S>
inline S deviation(const S* gradient, const S* covariance, int n) noexcept {
    S sum = S(0);
    int entry = 0;
    for (int u = 0; u < n; ++u) {
        for (int v = u; v < n; ++v, ++entry) sum += (u == v ? S(1) : S(2)) * gradient[u] * gradient[v] * covariance[entry];
    }
    return std::sqrt(sum);
}

/// Bias of a function of theta: g' b + trace(H C)/2, H its second derivatives (packed upper triangle). Cost: n^2 operations.
template <class S>
inline S bias_of_function(const S* gradient, const S* curvature, const S* covariance, const S* bias, int n) noexcept {
    S sum = S(0);
    int entry = 0;
    for (int u = 0; u < n; ++u) {
        sum += gradient[u] * bias[u];
        for (int v = u; v < n; ++v, ++entry) sum += (u == v ? S(0.5) : S(1)) * curvature[entry] * covariance[entry];
    }
    return sum;
}

}  // namespace algest
