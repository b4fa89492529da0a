// SPDX-License-Identifier: MIT-0
// Windowed moments: the weights of a kernel are, but for the ends of the window, samples of one polynomial, so that all functionals of one
// signal follow from its d+1 moments, at a cost that does not depend on the length of the window.
//
// The textbook recursion (subtract the oldest, shift by a binomial matrix) is a Jordan block: its rounding grows like (N/M)^d and never
// heals. Here accumulators are anchored in frames that stand still. One is served (the newest sample is added, the oldest one removed) while
// the others are summed anew, one a block later than the next; after every block the fullest of them takes over and the one that served
// starts again from nothing. Nothing is summed for longer than a window and a block. Each frame measures a signal from the sample that it
// starts with, for offsets would drown it: F[x] = F[x - c] + c F[1].
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "algest/rows.hpp"
#include "algest/twofold.hpp"
#include "algest/view.hpp"

namespace algest {

/// Frames that are summed anew while one is served. More of them keep the window near the middle of its frame, where the shift to the window
/// loses fewest digits; two floats have digits to lose, and their sums cost more.
template <class A>
inline constexpr int rebuilt_frames = 3;
template <class S>
inline constexpr int rebuilt_frames<Twofold<S>> = 2;
template <class A>
inline constexpr int moment_frames = rebuilt_frames<A> + 1;
/// Samples from the start of one frame to that of the next.
template <class A>
constexpr int moment_block(int intervals) noexcept {
    return (intervals + rebuilt_frames<A> - 1) / rebuilt_frames<A>;
}
/// Samples in one frame, from its start until another takes over; at most twice the window.
template <class A>
constexpr int frame_samples(int intervals) noexcept {
    return intervals + moment_block<A>(intervals);
}

/// What a table counts besides its polynomial: for the oldest and the newest sample of a window; and the functional of the constant 1.
template <class S>
struct WindowEnds {
    S oldest;
    S newest;
    S of_one;
    S gain;       ///< of rounding: eight roundings of |value| + |c F[1]| + gain times the frame's sum of |x - c| bound that of a value
    int degree;   ///< of the polynomial
};

/// Eight roundings in line, as rounding_part counts them; those of the sums are in the gains.
template <class S>
constexpr S moment_rounding_part() noexcept {
    return S(8) * (std::numeric_limits<S>::epsilon() / S(2));
}

/// The functionals of an estimator as polynomials, by table. A polynomial is in v = (2m - M) step, m = 0 the oldest sample of M + 1; `step` is a
/// power of two with 2 M step <= 1, so that coordinates are exact.
template <class S, class A>
struct MomentSet {
    int degree;                      ///< the largest, d
    S step;
    View<unsigned char> degrees;     ///< by signal, the largest of its tables
    View<A> coefficients;            ///< d + 1 a table, lowest power first
    View<WindowEnds<S>> ends;
};

/// Where the frames stand.
struct MomentProgress {
    std::int32_t position;   ///< of the newest sample, modulo the cycle of all frames
    std::int32_t growing;    ///< samples that the frame of a growing window holds: a power of two
};

/// Accumulators, and scalars of references (and as many sizes) and ring, of an instance; accumulators of scratch that push needs. A growing window has a frame
/// of its own behind the others.
template <class A>
constexpr int moment_accumulators(int signals, int degree, bool growing) noexcept {
    return (moment_frames<A> + (growing ? 1 : 0)) * signals * (degree + 1);
}
template <class A>
constexpr int moment_references(int signals) noexcept {
    return moment_frames<A> * signals;
}
constexpr int moment_ring(int signals, int samples) noexcept { return signals * samples; }
constexpr int moment_scratch(int signals, int degree) noexcept { return (signals + 1) * (degree + 1); }

/// The arrays of one instance.
template <class S, class A>
struct MomentMemory {
    A* accumulators;   ///< by frame, signal, power
    S* references;     ///< by frame, signal: what is subtracted from its samples
    S* sizes;          ///< by frame, signal: sum of the absolute values of what was added, those that have left included
    MomentProgress* progress;
};

namespace detail {

/// powers[j] = u^j.
template <class S, class A>
inline void powers_of(S u, int degree, A* powers) noexcept {
    assign(powers[0], S(1));
    for (int j = 1; j <= degree; ++j) powers[j] = times(powers[j - 1], u);
}

/// moments[j] += powers[j] x, j = 0 .. top. Unrolled where a product is short; that of two floats hides the loop.
template <class S>
inline void add_products(const double* powers, int top, S x, double* moments) noexcept {
#pragma GCC unroll 4
    for (int j = 0; j <= top; ++j) add_product(moments[j], powers[j], x);
}
template <class S>
inline void add_products(const Twofold<S>* powers, int top, S x, Twofold<S>* moments) noexcept {
    for (int j = 0; j <= top; ++j) add_product(moments[j], powers[j], x);
}

/// Adds a sample at coordinate u of a frame, `sized` to its sizes too; sign -1 takes it away.
template <bool sized, class S, class A>
inline void add_to_frame(const MomentSet<S, A>& set, S u, S sign, const S* sample, const S* references, S* sizes, A* powers, A* accumulators) noexcept {
    powers_of(u, set.degree, powers);
    for (int s = 0; s < set.degrees.size; ++s) {
        const S x = sign * (sample[s] - references[s]);
        if (sized) sizes[s] += std::abs(x);
        add_products(powers, set.degrees[s], x, accumulators + s * (set.degree + 1));
    }
}

/// Moments of a frame -> of coordinates larger by `shift`: a triangular matrix of binomials, factor by factor.
template <class S, class A>
inline void shift_moments(int degree, S shift, A* moments) noexcept {
    int pass = 1;
    for (; pass < degree; pass += 2) {   // two passes at once: what the first makes of a moment is still at hand for the second
        A above = moments[degree];
        A here = moments[degree - 1];
        add_product(above, here, shift);
        for (int j = degree; j > pass; --j) {
            const A below = moments[j - 2];
            add_product(here, below, shift);
            add_product(above, here, shift);
            moments[j] = above;
            above = here;
            here = below;
        }
        moments[pass] = above;
    }
    if (pass == degree) add_product(moments[degree], moments[degree - 1], shift);
}

}  // namespace detail

/// Starts all frames anew: call before the first sample after a refused one. What they hold is overwritten before it is served.
inline void restart_moments(MomentProgress& progress) noexcept { progress.position = -1; }

/// Takes one sample of every signal; `leaving` left the window with it (any finite values while the window fills).
/// scratch: degree + 1. Cost: (rebuilt_frames + 2) signals (degree + 1) products and sums, with each signal's own degree. Never fails; what is not finite is gone after frame_samples.
template <class S, class A>
inline void add_sample(const MomentSet<S, A>& set, int intervals, MomentMemory<S, A> memory, const S* sample, const S* leaving, A* scratch) noexcept {
    const int block = moment_block<A>(intervals);
    const int life = frame_samples<A>(intervals);
    const int cycle = moment_frames<A> * block;
    const int signals = set.degrees.size;
    const int size = signals * (set.degree + 1);
    const int position = memory.progress->position + 1 == cycle ? 0 : static_cast<int>(memory.progress->position) + 1;
    memory.progress->position = position;
    for (int f = 0; f < moment_frames<A>; ++f) {
        const int k = position - f * block + (position < f * block ? cycle : 0);
        S* const references = memory.references + f * signals;
        S* const sizes = memory.sizes + f * signals;
        A* const accumulators = memory.accumulators + f * size;
        if (k == 0) {
            for (int s = 0; s < signals; ++s) references[s] = sample[s];
            for (int s = 0; s < signals; ++s) sizes[s] = S(0);
            for (int i = 0; i < size; ++i) assign(accumulators[i], S(0));
        }
        if (k >= life) continue;
        detail::add_to_frame<true>(set, S(2 * k - (life - 1)) * set.step, S(1), sample, references, sizes, scratch, accumulators);
        if (k > intervals) detail::add_to_frame<false>(set, S(2 * (k - intervals - 1) - (life - 1)) * set.step, S(-1), leaving, references, sizes, scratch, accumulators);
    }
}

/// Evaluates all rows on the full window: matrix[row * (unknowns + 1) + column], as evaluate_rows does from weights. oldest, newest: samples of
/// every signal. scratch: moment_scratch. An entry that is no larger than its own rounding is zero.
/// Cost: signals degree (degree + 1)/2 + functionals (degree + 5) products and sums. Never fails; a value that is not finite passes through.
template <class S, class A>
inline void evaluate_moment_rows(const MomentSet<S, A>& set, const RowSet<S>& rows, MomentMemory<S, A> memory, const S* oldest, const S* newest, A* scratch,
                                 RowSums<S> to) noexcept {
    const int intervals = rows.samples - 1;
    const int block = moment_block<A>(intervals);
    const int since = static_cast<int>(memory.progress->position) - intervals;   // the start of the frame that is served
    const int full = since < 0 ? since + moment_frames<A> * block : since;
    int frame = 0;
    int offset = full;
    for (; offset >= block; offset -= block) ++frame;   // a few subtractions; a division takes longer
    const int count = set.degree + 1;
    const S* const references = memory.references + frame * rows.signals;
    const S* const sizes = memory.sizes + frame * rows.signals;
    const A* const served = memory.accumulators + frame * rows.signals * count;
    const S shift = S(block - 1 - 2 * offset) * set.step;
    for (int s = 0; s < rows.signals; ++s) {
        for (int j = 0; j <= set.degrees[s]; ++j) scratch[s * count + j] = served[s * count + j];
        detail::shift_moments<S>(set.degrees[s], shift, scratch + s * count);
    }

    clear_rows(rows, to);
    for (const Functional& f : rows.functionals) {
        if (f.table == no_table) {
            add_functional(rows, f, S(1), S(1), to);
            continue;
        }
        const A* const moments = scratch + f.signal * count;
        const A* const coefficients = set.coefficients.data + f.table * count;
        const WindowEnds<S>& ends = set.ends[f.table];
        A sum;
        assign(sum, S(0));
        for (int j = 0; j <= ends.degree; ++j) add_product(sum, coefficients[j], moments[j]);
        const S c = references[f.signal];
        const S at_ends = ends.oldest * (oldest[f.signal] - c) + ends.newest * (newest[f.signal] - c);
        const S of_reference = c * ends.of_one;
        const S value = (rounded<S>(sum) + at_ends) + of_reference;
        add_functional(rows, f, value, (std::abs(value) + std::abs(of_reference)) + ends.gain * sizes[f.signal], to);
    }
    drop_rounding(rows, moment_rounding_part<S>(), to);
}

}  // namespace algest
