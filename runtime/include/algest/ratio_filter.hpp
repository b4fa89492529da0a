// SPDX-License-Identifier: MIT-0
// Numerator and denominator of each unknown through one and the same second-order low-pass (Delpoux, Floquet, equation 43, with the
// 2 zeta omega_n s that its print lacks): theta_l = N_l / D with D = det S(t) and N_l = theta_l D, by Cramer's rule. An instant counts with
// its determinant, so that one at which the rows say little moves the quotient little; but with no more than most_weight of the filtered
// denominator, so that one bad sample does not outweigh all that follows.
#pragma once
#include <limits>

#include "algest/arithmetic.hpp"

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

/// Most that one instant counts, in filtered denominators. The denominator can still rise by the factor e in half a 1/omega_n.
template <class S>
constexpr S most_weight() noexcept {
    return S(10);
}
/// A determinant that changes by more than this factor, or its inverse, from one instant to the next is another experiment: the filter
/// starts anew. S(t) takes many instants to change when a signal does; an outlier, and its end, change it at once.
template <class S>
constexpr S most_growth() noexcept {
    return S(1048576);
}

/// Scalars of state: started or not, the scales of the newest instant, in whose determinant the state counts, and (y, y'/omega_n, u) of
/// every numerator and of the denominator.
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

/// Counts the state in the scales of a new instant; false where the filter has to start anew: it has not begun, its denominator has faded or
/// swung below 0, or the determinant has leapt.
template <class S>
inline bool follow(S* state, const S* scales, int unknowns) noexcept {
    S* const reference = state + 1;
    S* const x = reference + unknowns;
    S growth = S(1);
    for (int i = 0; i < unknowns; ++i) {
        const S ratio = scales[i] / reference[i];
        growth *= ratio * ratio;
        reference[i] = scales[i];
    }
    if (state[0] == S(0) || !within(growth, S(1) / most_growth<S>(), most_growth<S>())) return false;
    for (int i = 0; i < 3 * (unknowns + 1); ++i) x[i] /= growth;
    return x[3 * unknowns] > std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon() && all_finite(x, 3 * (unknowns + 1));
}

/// Replaces theta by the quotient of filtered numerators and denominator. pivots, scales: unknowns each; det S is the product of
/// pivot scale^2. False, and theta as it was, where the filtered denominator is not positive or a quotient not finite. Cost: 15 (unknowns+1)
/// operations.
template <class S>
inline bool filter_ratio(const LowPass<S>& filter, S* state, const S* pivots, int pivot_step, const S* scales, int unknowns, S* theta) noexcept {
    S* const x = state + 1 + unknowns;
    S* const of_denominator = x + 3 * unknowns;
    const bool first = !follow(state, scales, unknowns);
    state[0] = S(1);
    S weight = S(1);   // the determinant in this instant's scales
    for (int i = 0; i < unknowns; ++i) weight *= pivots[i * pivot_step];
    if (!first) weight = smaller(weight, most_weight<S>() * of_denominator[0]);
    const S denominator = advance(filter, of_denominator, weight, first);
    for (int i = 0; i < unknowns; ++i) (void)advance(filter, x + 3 * i, theta[i] * weight, first);
    if (!(denominator > S(0)) || !all_finite(x, 3 * (unknowns + 1))) {
        restart_ratio(state);
        return false;
    }
    for (int i = 0; i < unknowns; ++i) theta[i] = x[3 * i] / denominator;
    return true;
}

/// An instant whose rows are singular: determinant and numerators are 0.
template <class S>
inline void filter_nothing(const LowPass<S>& filter, S* state, int unknowns) noexcept {
    if (state[0] == S(0)) return;
    S* x = state + 1 + unknowns;
    for (int i = 0; i <= unknowns; ++i) (void)advance(filter, x + 3 * i, S(0), false);
}

}  // namespace algest
