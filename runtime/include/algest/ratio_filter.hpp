// SPDX-License-Identifier: MIT-0
// Numerator and denominator of each unknown through one and the same second-order low-pass (Delpoux, Floquet, equation 43, with the
// 2 zeta omega_n s that its print lacks): theta_l = N_l / D with D = det S(t) and N_l = theta_l D, by Cramer's rule. An instant counts with
// its determinant, so that one at which the rows say little moves the quotient little.
#pragma once

namespace algest {

/// x' = A x + b u, exact for an input u that goes straight from one sample to the next: x = transition x + before u_old + now u_new, with
/// x = (y, y'/omega_n) and y the output.
template <class S>
struct LowPass {
    bool used;
    S transition[4];
    S before[2];
    S now[2];
};

/// Scalars of state: started or not, the scales that the determinant is divided by, and (y, y'/omega_n, u) of every numerator and of the
/// denominator.
constexpr int ratio_scalars(bool used, int unknowns) noexcept { return used ? 1 + unknowns + 3 * (unknowns + 1) : 1; }

/// Forgets what went through.
template <class S>
inline void restart_ratio(S* state) noexcept {
    state[0] = S(0);
}

/// Moves one low-pass on by the input u; its output. A first input is taken as if it had stood for ever.
template <class S>
inline S advance(const LowPass<S>& filter, S* x, S u, bool first) noexcept {
    if (first) {
        x[0] = u;
        x[1] = S(0);
    } else {
        const S y = filter.transition[0] * x[0] + filter.transition[1] * x[1] + filter.before[0] * x[2] + filter.now[0] * u;
        x[1] = filter.transition[2] * x[0] + filter.transition[3] * x[1] + filter.before[1] * x[2] + filter.now[1] * u;
        x[0] = y;
    }
    x[2] = u;
    return x[0];
}

/// Replaces theta by the quotient of filtered numerators and denominator. pivots, scales: unknowns each; det S is the product of
/// pivot scale^2. False, and theta as it was, where the filtered denominator is not positive. Cost: 10 (unknowns+1) operations.
template <class S>
inline bool filter_ratio(const LowPass<S>& filter, S* state, const S* pivots, int pivot_step, const S* scales, int unknowns, S* theta) noexcept {
    const bool first = state[0] == S(0);
    S* reference = state + 1;
    S* x = reference + unknowns;
    if (first) {
        for (int i = 0; i < unknowns; ++i) reference[i] = scales[i];
        state[0] = S(1);
    }
    S determinant = S(1);   // over that of the first instant's scales: neither under- nor overflows where units are small or large
    for (int i = 0; i < unknowns; ++i) {
        const S scale = scales[i] / reference[i];
        determinant *= pivots[i * pivot_step] * scale * scale;
    }
    const S denominator = advance(filter, x + 3 * unknowns, determinant, first);
    const bool positive = denominator > S(0);
    for (int i = 0; i < unknowns; ++i) {
        const S numerator = advance(filter, x + 3 * i, theta[i] * determinant, first);
        if (positive) theta[i] = numerator / denominator;
    }
    return positive;
}

/// An instant whose rows are singular: determinant and numerators are 0.
template <class S>
inline void filter_nothing(const LowPass<S>& filter, S* state, int unknowns) noexcept {
    if (state[0] == S(0)) return;
    S* x = state + 1 + unknowns;
    for (int i = 0; i <= unknowns; ++i) (void)advance(filter, x + 3 * i, S(0), false);
}

}  // namespace algest
