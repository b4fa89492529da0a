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
#include <type_traits>

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

/// Neighbours among powers and moments, as a unit of 16 bytes has them.
using Pair = Neighbours<double>::Lanes;
inline Pair pair_at(const double* from) noexcept { return *reinterpret_cast<const Neighbours<double>::Unaligned*>(from); }
inline void put_pair(double* to, Pair x) noexcept { *reinterpret_cast<Neighbours<double>::Unaligned*>(to) = x; }
inline Pair both(double x) noexcept { return Pair{x, x}; }

/// A degree that the compiler knows: loops are unrolled, and what they use stays in registers.
template <int degree>
using Known = std::integral_constant<int, degree>;

/// work(degree), with a known one where sums are double and the processor has a vector unit. A controller would pay with its flash for what it
/// cannot use. The operations are the same, and so are the answers to the last bit. Always inline: behind a call, work's references are read from
/// memory one by one (a tenth of the time of a sample).
template <class A, class Work>
[[gnu::always_inline]] inline void with_degree(int degree, const Work& work) noexcept {
#if defined(__SSE2__) || defined(__aarch64__)
    if constexpr (std::is_same<A, double>::value) {
        switch (degree) {
            case 1: return work(Known<1>());
            case 2: return work(Known<2>());
            case 3: return work(Known<3>());
            case 4: return work(Known<4>());
            case 5: return work(Known<5>());
            case 6: return work(Known<6>());
            case 7: return work(Known<7>());
            case 8: return work(Known<8>());
            case 9: return work(Known<9>());
            case 10: return work(Known<10>());
            default: break;
        }
    }
#endif
    work(degree);
}

/// Of a loop: that of its signal or table. What is unrolled goes to the largest, where coefficients are zero.
inline int own_degree(int, int own) noexcept { return own; }
template <int degree>
inline Known<degree> own_degree(Known<degree> all, int) noexcept { return all; }

/// powers[j] = u^j, j = 0 .. degree. In double in pairs, each from the one before by u^2; behind an even degree stands one more.
template <class S>
inline void powers_of(S u, int degree, double* powers) noexcept {
    const double x = static_cast<double>(u);
    Pair pair = {1.0, x};
    put_pair(powers, pair);
    for (int j = 2; j <= degree; j += 2) put_pair(powers + j, pair *= both(x * x));
}
template <class S>
inline void powers_of(S u, int degree, Twofold<S>* powers) noexcept {
    assign(powers[0], S(1));
    for (int j = 1; j <= degree; ++j) powers[j] = times(powers[j - 1], u);
}

/// moments[j] += powers[j] x, j = 0 .. top.
template <class S>
inline void add_products(const double* powers, int top, S x, double* moments) noexcept {
    const double factor = static_cast<double>(x);
    int j = 0;
    for (; j < top; j += 2) put_pair(moments + j, pair_at(moments + j) + pair_at(powers + j) * both(factor));
    if (j == top) moments[j] += powers[j] * factor;
}
template <class S>
inline void add_products(const Twofold<S>* powers, int top, S x, Twofold<S>* moments) noexcept {
    for (int j = 0; j <= top; ++j) add_product(moments[j], powers[j], x);
}

/// Adds a sample at coordinate u of a frame, `sized` to its sizes too; sign -1 takes it away.
template <bool sized, class S, class A>
inline void add_to_frame(const MomentSet<S, A>& set, int, S u, S sign, const S* sample, const S* references, S* sizes, A* powers, A* accumulators) noexcept {
    powers_of(u, set.degree, powers);
    for (int s = 0; s < set.degrees.size; ++s) {
        const S x = sign * (sample[s] - references[s]);
        if (sized) sizes[s] += std::abs(x);
        add_products(powers, set.degrees[s], x, accumulators + s * (set.degree + 1));
    }
}
template <bool sized, class S, int degree>
inline void add_to_frame(const MomentSet<S, double>& set, Known<degree>, S u, S sign, const S* sample, const S* references, S* sizes, double*, double* accumulators) noexcept {
    const double v = static_cast<double>(u);
    Pair powers[degree / 2 + 1] = {{1.0, v}};
#pragma GCC unroll 8
    for (int j = 1; j <= degree / 2; ++j) powers[j] = powers[j - 1] * both(v * v);
    const int signals = set.degrees.size;   // once: pairs may alias it
    for (int s = 0; s < signals; ++s) {
        const S x = sign * (sample[s] - references[s]);
        if (sized) sizes[s] += std::abs(x);
        const double factor = static_cast<double>(x);
        double* const moments = accumulators + s * (degree + 1);
#pragma GCC unroll 8
        for (int j = 0; j < degree; j += 2) put_pair(moments + j, pair_at(moments + j) + powers[j / 2] * both(factor));
        if constexpr (degree % 2 == 0) moments[degree] += powers[degree / 2][0] * factor;
    }
}

/// sum over j = 0 .. top of coefficients[j] moments[j]; in double those of even j, those of odd j, then both.
inline double sum_of_products(const double* coefficients, const double* moments, int top) noexcept {
    Pair sums = {0.0, 0.0};
    int j = 0;
    for (; j < top; j += 2) sums += pair_at(coefficients + j) * pair_at(moments + j);
    if (j == top) sums[0] += coefficients[j] * moments[j];
    return sums[0] + sums[1];
}
template <int degree>
inline double sum_of_products(const double* coefficients, const double* moments, Known<degree>) noexcept {
    Pair sums = {0.0, 0.0};
#pragma GCC unroll 8
    for (int j = 0; j < degree; j += 2) sums += pair_at(coefficients + j) * pair_at(moments + j);
    if constexpr (degree % 2 == 0) sums[0] += coefficients[degree] * moments[degree];
    return sums[0] + sums[1];
}
template <class S>
inline Twofold<S> sum_of_products(const Twofold<S>* coefficients, const Twofold<S>* moments, int top) noexcept {
    Twofold<S> sum = {S(0), S(0)};
    for (int j = 0; j <= top; ++j) add_product(sum, coefficients[j], moments[j]);
    return sum;
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

/// The same of moments that stand elsewhere.
template <class S, class A>
inline void shifted_moments(int degree, S shift, const A* from, A* moments) noexcept {
    for (int j = 0; j <= degree; ++j) moments[j] = from[j];
    shift_moments(degree, shift, moments);
}
template <class S, int degree>
inline void shifted_moments(Known<degree>, S shift, const double* from, double* to) noexcept {
    double moments[degree + 1];
#pragma GCC unroll 11
    for (int j = 0; j <= degree; ++j) moments[j] = from[j];
#pragma GCC unroll 11
    for (int pass = 1; pass <= degree; ++pass) {
#pragma GCC unroll 11
        for (int j = degree; j >= pass; --j) add_product(moments[j], moments[j - 1], shift);
    }
#pragma GCC unroll 8
    for (int j = 0; j < degree; j += 2) put_pair(to + j, Pair{moments[j], moments[j + 1]});   // as they are read
    if constexpr (degree % 2 == 0) to[degree] = moments[degree];
}

/// add_sample, for one degree.
template <class S, class A, class Degree>
inline void add_sample_of(Degree degree, const MomentSet<S, A>& set, int intervals, const MomentMemory<S, A>& memory, const S* sample, const S* leaving, A* scratch) noexcept {
    const int block = moment_block<A>(intervals);
    const int life = frame_samples<A>(intervals);
    const int cycle = moment_frames<A> * block;
    const int signals = set.degrees.size;
    const int size = signals * (set.degree + 1);
    const S step = set.step;
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
        add_to_frame<true>(set, degree, S(2 * k - (life - 1)) * step, S(1), sample, references, sizes, scratch, accumulators);
        if (k > intervals) add_to_frame<false>(set, degree, S(2 * (k - intervals - 1) - (life - 1)) * step, S(-1), leaving, references, sizes, scratch, accumulators);
    }
}

/// evaluate_moment_rows from the moments of the frame that is served, to coordinates larger by `shift`.
template <class S, class A, class Degree>
inline void evaluate_served(Degree degree, const MomentSet<S, A>& set, const RowSet<S>& rows, const A* served, const S* references, const S* sizes, S shift, const S* oldest, const S* newest,
                            A* scratch, const RowSums<S>& to) noexcept {
    const int count = degree + 1;
    for (int s = 0; s < rows.signals; ++s) shifted_moments(own_degree(degree, set.degrees[s]), shift, served + s * count, scratch + s * count);
    clear_rows(rows, to);
    int signal = -1;   // of the functional before
    const A* moments = scratch;
    S c{}, first{}, last{}, size{};
    for (const Functional& f : rows.functionals) {
        if (f.table == no_table) {
            add_functional(rows, f, S(1), S(1), to);
            continue;
        }
        if (f.signal != signal) {
            signal = f.signal;
            moments = scratch + signal * count;
            c = references[signal];
            first = oldest[signal] - c;
            last = newest[signal] - c;
            size = sizes[signal];
        }
        const WindowEnds<S>& ends = set.ends[f.table];
        const A sum = sum_of_products(set.coefficients.data + f.table * count, moments, own_degree(degree, ends.degree));
        const S of_reference = c * ends.of_one;
        const S value = (rounded<S>(sum) + (ends.oldest * first + ends.newest * last)) + of_reference;
        add_functional(rows, f, value, (std::abs(value) + std::abs(of_reference)) + ends.gain * size, to);
    }
    drop_rounding(rows, moment_rounding_part<S>(), to);
}

}  // namespace detail

/// Starts all frames anew: call before the first sample after a refused one. What they hold is overwritten before it is served.
inline void restart_moments(MomentProgress& progress) noexcept { progress.position = -1; }

/// Takes one sample of every signal; `leaving` left the window with it (any finite values while the window fills).
/// scratch: moment_scratch. Cost: (rebuilt_frames + 2) signals (degree + 1) products and sums, with each signal's own degree. Never fails; what is not finite is gone after frame_samples.
template <class S, class A>
inline void add_sample(const MomentSet<S, A>& set, int intervals, const MomentMemory<S, A>& memory, const S* sample, const S* leaving, A* scratch) noexcept {
    detail::with_degree<A>(set.degree, [&](auto degree) { detail::add_sample_of(degree, set, intervals, memory, sample, leaving, scratch); });
}

/// Evaluates all rows on the full window: matrix[row * (unknowns + 1) + column], as evaluate_rows does from weights. oldest, newest: samples of
/// every signal. scratch: moment_scratch. An entry that is no larger than its own rounding is zero.
/// Cost: signals degree (degree + 1)/2 + functionals (degree + 5) products and sums. Never fails; a value that is not finite passes through.
template <class S, class A>
inline void evaluate_moment_rows(const MomentSet<S, A>& set, const RowSet<S>& rows, const MomentMemory<S, A>& memory, const S* oldest, const S* newest, A* scratch,
                                 const RowSums<S>& to) noexcept {
    const int intervals = rows.samples - 1;
    const int block = moment_block<A>(intervals);
    const int since = static_cast<int>(memory.progress->position) - intervals;   // the start of the frame that is served
    const int full = since < 0 ? since + moment_frames<A> * block : since;
    int frame = 0;
    int offset = full;
    for (; offset >= block; offset -= block) ++frame;   // a few subtractions; a division takes longer
    const int count = set.degree + 1;
    detail::with_degree<A>(set.degree, [&](auto degree) {
        detail::evaluate_served(degree, set, rows, memory.accumulators + frame * rows.signals * count, memory.references + frame * rows.signals, memory.sizes + frame * rows.signals,
                                S(block - 1 - 2 * offset) * set.step, oldest, newest, scratch, to);
    });
}

}  // namespace algest
