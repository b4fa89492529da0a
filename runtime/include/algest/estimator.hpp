// SPDX-License-Identifier: MIT-0
// The estimator behind every generated class and every replay: samples -> windows -> rows -> solve.
//
// One producer calls push (an interrupt, say), one consumer calls estimate (the background). The consumer copies what it
// needs under a sequence counter, and reads window samples that the producer does not touch for spare_samples more pushes.
// Copies that a push has spoilt are thrown away; C++ still calls such reads a data race, and ThreadSanitizer reports them.
//
// What solves is always inlined into the member of the class that calls it: there the blueprint is a constant, so that a compiler leaves out every
// solver but the one that is asked for. As functions they would all be linked, three quarters of an estimator's code.
#pragma once
#include <cstdint>

#include "algest/abi.hpp"
#include "algest/arithmetic.hpp"
#include "algest/elimination.hpp"
#include "algest/gram_window.hpp"
#include "algest/noise.hpp"
#include "algest/noise_gram.hpp"
#include "algest/normalised_rows.hpp"
#include "algest/point_noise.hpp"
#include "algest/point_uncertainty.hpp"
#include "algest/ratio_filter.hpp"
#include "algest/rows.hpp"
#include "algest/solve_gram.hpp"
#include "algest/solve_rows.hpp"
#include "algest/status.hpp"
#include "algest/triangle_update.hpp"
#include "algest/uncertainty.hpp"
#include "algest/whitening.hpp"
#include "algest/window.hpp"

namespace algest {

enum class Solve : std::uint8_t {
    square,         ///< the rows of the newest instant alone, solved in estimate(); in the least-squares sense if there are more than unknowns
    robust,         ///< S(t) over the last solve_instants instants, summed in push()
    least_squares,  ///< every row since reset, absorbed in push()
    elimination     ///< likewise; the columns are polynomials of fewer parameters
};

/// An estimator as constant data, shared by all its instances.
template <class S>
struct Blueprint {
    RowSet<S> rows;
    Solve solve;
    int solve_instants;   ///< robust: instants in S(t)
    S keep;               ///< least_squares and elimination: factor on the old triangle at each instant; 1 forgets nothing
    S condition_limit;    ///< above it an estimate is singular
    int kept;             ///< samples that the rings keep beyond one window; kept_samples() or more
    Noise<S> noise;       ///< of the sensors
    S deviation_limit;    ///< an estimate is singular where a standard deviation exceeds this part of its unknown, see `sizes`; 0: not asked
    View<S> whiten_at;    ///< unknowns at which rows are whitened until the first ok estimate; empty: they are not whitened
    LowPass<S> ratio;     ///< robust: of numerators and denominator
    RowSet<S> perturbation;   ///< rows whose residuals at the estimate are the perturbation's coefficients; none: rows == 0
    bool normalise = false;   ///< square: rows are divided by their largest entry, and the condition is that before columns are scaled
    Elimination<S> elimination = {};   ///< what the columns mean; otherwise empty
    bool rows_published = false;   ///< push evaluates the rows that estimate needs, and publishes them: the windows are moments, which nobody else can read
    int shortest = 0;              ///< samples of the shortest window that is solved, where windows grow; 0: they do not
    View<S> noise_floor = {};      ///< robust: what declared noise alone may make of S(t), packed upper triangle; an estimate is singular where S(t)
                                   ///< does not rise above it. Empty: not asked. Normalised rows: of each what noise of deviation 1 in `output` makes
    View<S> sizes = {};            ///< with a deviation limit: absolute values of the unknowns, where they are expected; one that is found
                                   ///< smaller counts as large as this, so that one which is really zero is not refused
    S margin_over_noise = S(0);    ///< least_squares and elimination, windows of one sample; normalised rows: an estimate is singular unless the rows see
                                   ///< every combination of its unknowns by this many times the square of what noise puts there; 0: not asked
    std::uint16_t output = 0;      ///< normalised rows: the window signal that noise enters by
    S output_noise = S(0);         ///< its declared standard deviation
    PointRows points = {};         ///< least_squares and elimination, with a margin over noise: the rows of an operating point

    constexpr int needed() const noexcept { return shortest > 0 ? shortest : rows.samples; }
};

/// Pushes that may fall into one reading of the windows without spoiling it.
constexpr int spare_samples = 8;
/// Copies of the sums that push() publishes in turn.
constexpr int published_slots = 4;

/// Samples beyond one window that rings must keep: estimate() reads windows where the rows of one instant are solved or a perturbation
/// is asked for; uncertainty() reads all windows of S(t).
constexpr int kept_samples(Solve solve, int instants, bool uncertain, bool perturbation) noexcept {
    return (solve == Solve::square || (uncertain && solve == Solve::robust) || perturbation ? spare_samples : 0) + (solve == Solve::robust && uncertain ? instants - 1 : 0);
}
constexpr int ring_length(int samples, int kept) noexcept { return samples + kept; }
constexpr int sum_scalars(Solve solve, int unknowns, int instants) noexcept {
    return solve == Solve::square ? 1 : solve == Solve::robust ? gram_scalars(unknowns, instants) : triangle_scalars(unknowns);
}
constexpr int published_scalars(Solve solve, int unknowns) noexcept { return solve == Solve::square ? 1 : published_slots * packed_size(unknowns + 1); }
/// The same of operating points with a margin over noise: the sums of add_point stand behind the triangle, and behind them the moments, which are not published.
constexpr int sum_scalars(const PointRows& points, int unknowns) noexcept {
    return triangle_scalars(unknowns) + point_noise_scalars(unknowns, points.groups) + point_moments(points);
}
constexpr int published_scalars(const PointRows& points, int unknowns) noexcept {
    return published_slots * (triangle_scalars(unknowns) + point_noise_scalars(unknowns, points.groups));
}
/// The same where push publishes rows: those of the newest instant (square), and of the perturbation.
constexpr int published_row_scalars(Solve solve, int rows, int unknowns, int perturbation_rows) noexcept {
    const int solved = solve == Solve::square ? row_entries(rows, unknowns) : packed_size(unknowns + 1);
    return published_slots * (solved + row_entries(perturbation_rows, unknowns));
}
/// Scalars of scratch that push needs; with operating points all_change_products more. rows: of an instant; where push publishes rows, of the perturbation if
/// they are more.
constexpr int push_scratch(int rows, int unknowns) noexcept { return 2 * row_entries(rows, unknowns); }
/// Scalars of scratch that estimate needs without a deviation limit; with elimination elimination_scratch more, with a margin over noise
/// above_noise_scratch; of operating points with a margin point_scratch in all. rows: of an instant, or of the perturbation if they are more.
constexpr int estimate_scratch(int rows, int unknowns) noexcept {
    int most = solve_rows_scratch(unknowns);
    if (solve_gram_scratch(unknowns) > most) most = solve_gram_scratch(unknowns);
    if (solve_triangle_scratch(unknowns) > most) most = solve_triangle_scratch(unknowns);
    if (residual_factor_scratch(rows, unknowns) > most) most = residual_factor_scratch(rows, unknowns);
    return rows * (unknowns + 1) + packed_size(unknowns + 1) + rows * rows + most;
}
constexpr int above_noise_scratch(int unknowns, int groups = 0) noexcept {
    return (groups == 0 ? packed_size(unknowns) : point_noise_scalars(unknowns, groups)) + unknowns * unknowns;
}
template <class S>
constexpr int point_scratch(const Blueprint<S>& blueprint) noexcept {
    const int n = blueprint.rows.unknowns;
    return estimate_scratch(blueprint.rows.rows, n) + elimination_scratch(blueprint.elimination, true) + above_noise_scratch(n, blueprint.points.groups);
}
/// Of operating points, where uncertainty needs it, and estimate with a deviation limit.
template <class S>
constexpr int point_uncertainty_scratch(const Blueprint<S>& blueprint) noexcept {
    return point_scratch(blueprint) + propagate_points_scratch(blueprint.elimination, blueprint.rows.unknowns);
}
/// Scalars of scratch that uncertainty needs of a square or robust solve, and estimate with a deviation limit. instants: 0 unless robust.
constexpr int uncertainty_scratch(int rows, int unknowns, int instants) noexcept {
    return estimate_scratch(rows, unknowns) + node_count(instants) * rows * (2 * unknowns + 1) + unknowns * unknowns + packed_size(unknowns) +
           propagate_scratch(rows, unknowns);
}

/// How far the producer is. Written by push and reset alone.
struct Progress {
    std::uint32_t sequence;   ///< odd while push writes
    std::int32_t head;        ///< ring index that is written next
    std::int32_t filled;      ///< samples in the windows since the last restart, at most a window
    std::int32_t slot;        ///< published copy that is newest
    std::uint32_t absorbed;   ///< 1 when the sums hold what the solve needs
    std::uint32_t rejected;   ///< 1 when the newest sample was refused
    GramProgress gram;
    std::int32_t reserved;    ///< makes the size a multiple of 8 where int has 32 bits
};

/// The arrays of one instance; sizes by the functions above.
template <class S>
struct Memory {
    S* rings;
    S* sums;
    S* published;
    Progress* progress;
    S* whitened_at = nullptr;   ///< unknowns; the consumer's, where rows are whitened
    S* ratio = nullptr;         ///< ratio_scalars; the consumer's, where a ratio filter is used
};

namespace detail {

inline void begin_write(Progress& p) noexcept {
    __atomic_store_n(&p.sequence, p.sequence + 1U, __ATOMIC_RELAXED);
    __atomic_thread_fence(__ATOMIC_RELEASE);
}
inline void end_write(Progress& p) noexcept { __atomic_store_n(&p.sequence, p.sequence + 1U, __ATOMIC_RELEASE); }

/// Copies the producer's progress whole; false if three tries met a producer at work.
inline bool copy_progress(const Progress& from, Progress& to) noexcept {
    for (int attempt = 0; attempt < 3; ++attempt) {
        const std::uint32_t before = __atomic_load_n(&from.sequence, __ATOMIC_ACQUIRE);
        to = from;
        __atomic_thread_fence(__ATOMIC_ACQUIRE);
        const std::uint32_t after = __atomic_load_n(&from.sequence, __ATOMIC_RELAXED);
        to.sequence = before;
        if (before == after && (before & 1U) == 0U) return true;
    }
    return false;
}

/// Pushes begun since `then` was copied.
inline std::uint32_t pushes_since(const Progress& now, const Progress& then) noexcept {
    __atomic_thread_fence(__ATOMIC_ACQUIRE);
    return (__atomic_load_n(&now.sequence, __ATOMIC_RELAXED) - then.sequence + 1U) / 2U;
}

/// Scalars of one published copy.
template <class S>
constexpr int slot_scalars(const Blueprint<S>& blueprint) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    const int perturbation = blueprint.perturbation.rows;
    if (blueprint.rows_published) return published_row_scalars(blueprint.solve, rows.rows, rows.unknowns, perturbation) / published_slots;
    return published_scalars(blueprint.points, rows.unknowns) / published_slots;
}

/// Drops what the windows and S(t) hold; the rows that least_squares absorbed so far stay.
template <class S>
inline void refuse(const Blueprint<S>& blueprint, Memory<S> memory) noexcept {
    Progress& p = *memory.progress;
    p.filled = 0;
    p.rejected = 1;
    if (blueprint.solve == Solve::robust) {
        clear_gram(memory.sums, p.gram, blueprint.rows.unknowns);
        p.absorbed = 0;
    }
}

/// The copy that is published next.
template <class S>
inline S* next_slot(const Blueprint<S>& blueprint, Memory<S> memory) noexcept {
    Progress& p = *memory.progress;
    p.slot = p.slot + 1 == published_slots ? 0 : p.slot + 1;
    return memory.published + p.slot * slot_scalars(blueprint);
}

/// Adds the rows of the newest instant (destroyed) to the sums of the solve, and publishes the sums; where the published copy goes on behind them. points: of
/// an operating point, whose errors are summed, too.
template <bool points, class S>
inline S* absorb(const Blueprint<S>& blueprint, Memory<S> memory, S* matrix) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    Progress& p = *memory.progress;
    if (!all_finite(matrix, row_entries(rows.rows, rows.unknowns))) {
        // Rows that overflow are left out: the sums would not recover from them.
    } else if (blueprint.solve == Solve::robust) {
        add_instant(memory.sums, p.gram, matrix, rows.rows, rows.unknowns, blueprint.solve_instants);
        p.absorbed = gram_is_full(p.gram, blueprint.solve_instants) ? 1U : 0U;
    } else {
        add_rows(memory.sums, matrix, rows.rows, rows.unknowns, blueprint.keep);
        if constexpr (points) add_residuals(blueprint.points, matrix, rows.unknowns, memory.sums + triangle_scalars(rows.unknowns));
        p.absorbed = 1;
    }
    S* const slot = next_slot(blueprint, memory);
    const int size = triangle_scalars(rows.unknowns) + (points ? point_noise_scalars(rows.unknowns, blueprint.points.groups) : 0);
    for (int k = 0; k < size; ++k) slot[k] = memory.sums[k];
    return slot + size;
}

}  // namespace detail

/// Forgets everything. Call it while neither push nor estimate runs.
template <class S>
inline void reset(const Blueprint<S>& blueprint, Memory<S> memory) noexcept {
    *memory.progress = Progress{};
    for (int u = 0; u < blueprint.whiten_at.size; ++u) memory.whitened_at[u] = blueprint.whiten_at[u];
    if (blueprint.ratio.used) restart_ratio(memory.ratio);
    if (blueprint.solve == Solve::robust) clear_gram(memory.sums, memory.progress->gram, blueprint.rows.unknowns);
    if (blueprint.solve == Solve::least_squares || blueprint.solve == Solve::elimination) {
        const int size = triangle_scalars(blueprint.rows.unknowns);
        for (int i = 0; i < size; ++i) memory.sums[i] = S(0);
    }
}

/// The same of operating points with a margin over noise.
template <class S>
inline void reset_points(const Blueprint<S>& blueprint, Memory<S> memory) noexcept {
    reset(blueprint, memory);
    for (int i = triangle_scalars(blueprint.rows.unknowns); i < sum_scalars(blueprint.points, blueprint.rows.unknowns); ++i) memory.sums[i] = S(0);
}

namespace detail {

/// push and push_point: two functions, so that who has no operating points has no code for them.
template <bool points, class S>
inline void push_any(const Blueprint<S>& blueprint, Memory<S> memory, const S* sample, S* scratch) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    Progress& p = *memory.progress;
    const int length = ring_length(rows.samples, blueprint.kept);
    begin_write(p);
    if (sample == nullptr) {
        refuse(blueprint, memory);
        end_write(p);
        return;
    }
    p.rejected = 0;
    write_sample(memory.rings, rows.signals, length, p.head, sample);
    p.head = p.head + 1 == length ? 0 : p.head + 1;
    if (p.filled < rows.samples) ++p.filled;
    if (blueprint.solve != Solve::square && p.filled == rows.samples) {
        S* const spare = scratch + row_entries(rows.rows, rows.unknowns);
        const WindowPosition window_at = newest(rows.samples, length, p.head);
        evaluate_rows(rows, memory.rings, window_at, scratch, spare);
        if constexpr (points) {
            S* const sums = memory.sums + triangle_scalars(rows.unknowns);
            if (all_finite(scratch, row_entries(rows.rows, rows.unknowns))) {
                add_point(rows, blueprint.noise, blueprint.points, memory.rings, window_at, blueprint.keep, scratch, spare, sums,
                          sums + point_noise_scalars(rows.unknowns, blueprint.points.groups));
            }
        }
        (void)absorb<points>(blueprint, memory, scratch);
    }
    end_write(p);
}

}  // namespace detail

/// Takes one sample of every signal; nullptr says that the newest sample was refused: the windows and S(t) restart,
/// the rows that least_squares and elimination absorbed so far stay. Cost: square: one store per signal; else one evaluation of all rows and
/// their absorption. Never fails.
template <class S>
inline void push(const Blueprint<S>& blueprint, Memory<S> memory, const S* sample, S* scratch) noexcept {
    detail::push_any<false>(blueprint, memory, sample, scratch);
}

/// The same for operating points with a margin over noise: what errors of their means make of the rows is summed, too.
template <class S>
inline void push_point(const Blueprint<S>& blueprint, Memory<S> memory, const S* sample, S* scratch) noexcept {
    detail::push_any<true>(blueprint, memory, sample, scratch);
}

/// Says that a sample was accepted which fills no window yet: the first of a run where signals are one sample late.
template <class S>
inline void prime(Memory<S> memory) noexcept {
    detail::begin_write(*memory.progress);
    memory.progress->rejected = 0;
    detail::end_write(*memory.progress);
}

/// What estimate found. `current == false`: push overtook it, nothing was computed, the caller keeps what it had.
template <class S>
struct Latest {
    bool current;
    Status status;
    S condition;   ///< of the scaled matrix that was solved; infinity unless status is ok or singular
};

namespace detail {

/// Scratch of estimate, in turn.
template <class S>
struct EstimateScratch {
    S* matrix;   ///< [P|Q] of the newest instant, whitened where that is asked for
    S* sums;     ///< packed [P|Q]'[P|Q], or the triangle
    S* factor;   ///< what whitens
    S* work;     ///< of the solvers
    S* noise;    ///< with a margin over noise: its packed Gram matrix, or the sums of add_point, then what tests it; else nullptr
};

/// True where the rows see every unknown by more than the margin over noise; noise: its packed Gram matrix, square: n x n of scratch.
template <class S>
inline bool above_noise(const S* triangle, int unknowns, S margin, const S* noise, S* square) noexcept {
    for (int i = 0; i < unknowns; ++i) {
        for (int j = i; j < unknowns; ++j) square[i * unknowns + j] = square[j * unknowns + i] = noise[packed_index(unknowns, i, j)];
    }
    return triangle_rises_above(triangle, unknowns, margin, square);
}

template <class S>
inline EstimateScratch<S> estimate_scratch_at(const RowSet<S>& rows, S* scratch, bool margin, int groups = 0) noexcept {
    S* const matrix = margin ? scratch + above_noise_scratch(rows.unknowns, groups) : scratch;
    S* const sums = matrix + rows.rows * (rows.unknowns + 1);
    S* const factor = sums + packed_size(rows.unknowns + 1);
    return {matrix, sums, factor, factor + rows.rows * rows.rows, margin ? scratch : nullptr};
}

/// True when pushes have spoilt what was read of the windows, or of the rows that push publishes, since `then` was copied.
template <class S>
inline bool overtaken(const Blueprint<S>& blueprint, Memory<S> memory, const Progress& then) noexcept {
    const int most = blueprint.rows_published ? published_slots - 1 : spare_samples;
    return pushes_since(*memory.progress, then) > static_cast<std::uint32_t>(most);
}

/// [P|Q] of the newest instant, whitened or normalised where that is asked for; false if it cannot be.
template <class S>
[[gnu::always_inline]] inline bool newest_rows(const Blueprint<S>& blueprint, Memory<S> memory, const Progress& then, const EstimateScratch<S>& at) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    if (blueprint.rows_published) {
        const S* const slot = memory.published + then.slot * slot_scalars(blueprint);
        for (int i = 0; i < row_entries(rows.rows, rows.unknowns); ++i) at.matrix[i] = slot[i];
        return true;
    }
    const WindowPosition window_at = newest(rows.samples, ring_length(rows.samples, blueprint.kept), then.head);
    evaluate_rows(rows, memory.rings, window_at, at.matrix, at.work);
    if (blueprint.normalise) {
        if (at.noise != nullptr) {
            noise_of_normalised_rows(at.matrix, rows.rows, rows.unknowns, blueprint.noise_floor.data, window(memory.rings, blueprint.output, window_at), rows.samples,
                                     blueprint.output_noise, at.noise);
        }
        return normalise_rows(at.matrix, rows.rows, rows.unknowns);
    }
    if (blueprint.whiten_at.size == 0) return true;
    if (!residual_factor(rows, blueprint.noise, memory.rings, window_at, memory.whitened_at, at.work, at.factor)) return false;
    whiten(at.factor, at.matrix, rows.rows, rows.unknowns + 1);
    return true;
}

/// Covariance and, unless nullptr, bias of `lumped`, which was solved at `then`. scratch: uncertainty_scratch; its first part as the solve left
/// it. False where the rows that were solved are not regular.
template <class S>
[[gnu::always_inline]] inline bool propagate(const Blueprint<S>& blueprint, Memory<S> memory, const Progress& then, S* scratch, const S* lumped, S* covariance,
                      S* bias) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    const int n = rows.unknowns;
    const int width = n + 1;
    const int entries = rows.rows * width;
    const int instants = blueprint.solve == Solve::robust ? blueprint.solve_instants : 0;
    const int span = rows.samples + (instants < 1 ? 0 : instants - 1);
    const int length = ring_length(rows.samples, blueprint.kept);
    const EstimateScratch<S> at = estimate_scratch_at(rows, scratch, false);
    S* const all_rows = scratch + algest::estimate_scratch(rows.rows, n);
    S* const gain = all_rows + node_count(instants) * entries;
    S* const inverse = gain + node_count(instants) * n * rows.rows;
    S* const column = inverse + n * n;
    S* const work = column + packed_size(n);
    const WindowPosition oldest = newest(span, length, then.head);
    Influence<S> by = {all_rows, gain, inverse, nullptr};

    if (blueprint.solve == Solve::square) {
        if (!newest_rows(blueprint, memory, then, at)) return false;
        if (blueprint.whiten_at.size > 0) by.factor = at.factor;
        for (int i = 0; i < entries; ++i) all_rows[i] = at.matrix[i];
        for (int r = 0; r < rows.rows; ++r) {   // how theta moves with Q of row r
            for (int i = 0; i < entries; ++i) at.matrix[i] = all_rows[i];
            for (int k = 0; k < rows.rows; ++k) at.matrix[k * width + n] = k == r ? S(1) : S(0);
            if (!solve_rows(at.matrix, rows.rows, n, at.work, column).regular) return false;
            for (int u = 0; u < n; ++u) gain[u * rows.rows + r] = column[u];
        }
        if (rows.rows == n) by.inverse = nullptr;
        for (int u = 0; u < n; ++u) {
            for (int v = 0; v < n; ++v) {
                S sum = S(0);
                for (int r = 0; r < rows.rows; ++r) sum += gain[u * rows.rows + r] * gain[v * rows.rows + r];
                inverse[u * n + v] = sum;
            }
        }
    } else {
        for (int k = 0; k < n; ++k) {           // column k of S^-1, by the copy that the solve left: push may have moved on from the published one
            for (int i = 0; i < n; ++i) at.sums[packed_index(width, i, n)] = i == k ? S(1) : S(0);
            if (!solve_gram(at.sums, n, at.work, column).regular) return false;
            for (int u = 0; u < n; ++u) inverse[u * n + k] = column[u];
        }
        for (int m = 0; m < node_count(instants); ++m) {
            const Node of = node(m, instants);
            const int start = oldest.start + of.start;
            S* const matrix = all_rows + m * entries;
            evaluate_rows(rows, memory.rings, WindowPosition{length, start >= length ? start - length : start}, matrix, at.work);
            for (int u = 0; u < n; ++u) {
                for (int r = 0; r < rows.rows; ++r) {
                    S sum = S(0);
                    for (int c = 0; c < n; ++c) sum += inverse[u * n + c] * matrix[r * width + c];
                    gain[(m * n + u) * rows.rows + r] = S(of.instants) * sum;
                }
            }
        }
    }
    propagate_noise(rows, blueprint.noise, memory.rings, oldest, instants, by, lumped, work, covariance, bias);
    return true;
}

/// Covariance and, unless nullptr, bias of what was solved from operating points. scratch: point_uncertainty_scratch, its first part as the solve left it.
/// The moments are read where push adds to them: what it began since the solve spoils them.
template <class S>
[[gnu::always_inline]] inline void propagate_all_points(const Blueprint<S>& blueprint, Memory<S> memory, S* scratch, S excess, const S* solution, S* covariance, S* bias) noexcept {
    const int n = blueprint.rows.unknowns;
    const EstimateScratch<S> at = estimate_scratch_at(blueprint.rows, scratch, true, blueprint.points.groups);
    const S* const moments = memory.sums + triangle_scalars(n) + point_noise_scalars(n, blueprint.points.groups);
    propagate_points(blueprint.points, blueprint.elimination, at.sums, at.noise, moments, n, excess, solution, scratch + point_scratch(blueprint), covariance, bias);
}

/// The residuals of the perturbation's rows at `lumped`.
template <class S>
inline void perturbation_of(const Blueprint<S>& blueprint, Memory<S> memory, const Progress& then, S* scratch, const S* lumped, S* out) noexcept {
    const RowSet<S>& rows = blueprint.perturbation;
    const int entries = row_entries(rows.rows, rows.unknowns);
    if (blueprint.rows_published) {
        const S* const behind = memory.published + (then.slot + 1) * slot_scalars(blueprint) - entries;
        for (int i = 0; i < entries; ++i) scratch[i] = behind[i];
    } else {
        evaluate_rows(rows, memory.rings, newest(rows.samples, ring_length(rows.samples, blueprint.kept), then.head), scratch, scratch + entries);
    }
    for (int r = 0; r < rows.rows; ++r) out[r] = residual(scratch + r * (rows.unknowns + 1), lumped, rows.unknowns);
}

/// True when no standard deviation exceeds the limit's part of its unknown, or of the size that it is expected to have.
template <class S>
inline bool certain_enough(const Blueprint<S>& blueprint, const S* covariance, const S* lumped) noexcept {
    const int unknowns = point_parameters(blueprint.elimination, blueprint.rows.unknowns);
    for (int u = 0; u < unknowns; ++u) {
        const S expected = blueprint.sizes.size > 0 ? blueprint.sizes[u] : S(0);
        const S most = blueprint.deviation_limit * larger(S(std::abs(lumped[u])), expected);
        if (!(covariance[packed_index(unknowns, u, u)] <= most * most)) return false;
    }
    return true;
}

/// estimate, and what it copied of the producer's progress. plain: without ratio filter, deviation limit and perturbation. excess: of operating points, how
/// many times the residuals are what the declared errors of the means explain; else 1.
template <class S>
[[gnu::always_inline]] inline Latest<S> estimate_at(const Blueprint<S>& blueprint, Memory<S> memory, S* scratch, S* lumped, Progress& then, bool plain, S& excess) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    const S none = std::numeric_limits<S>::infinity();
    const bool filters = !plain && blueprint.ratio.used;
    const bool limited = !plain && blueprint.deviation_limit > S(0);
    const bool perturbed = !plain && blueprint.perturbation.rows > 0;
    if (!copy_progress(*memory.progress, then)) return {false, Status::filling, none};
    const bool waits = then.rejected != 0U || then.filled < blueprint.needed() || (blueprint.solve != Solve::square && then.absorbed == 0U);
    if (waits) {
        if (filters) restart_ratio(memory.ratio);
        return {true, then.rejected != 0U ? Status::rejected : Status::filling, none};
    }

    const int n = rows.unknowns;
    const int size = packed_size(n + 1);
    const bool margin = blueprint.margin_over_noise > S(0);
    const int groups = blueprint.points.groups;
    const EstimateScratch<S> at = estimate_scratch_at(rows, scratch, margin, groups);
    S* const square_of_noise = margin ? at.noise + above_noise_scratch(n, groups) - n * n : nullptr;
    Solved<S> solved = {false, none};
    bool beyond_noise = true;
    if (blueprint.solve == Solve::square) {
        const bool usable = newest_rows(blueprint, memory, then, at);
        if (overtaken(blueprint, memory, then)) return {false, Status::filling, none};
        if (usable) solved = solve_rows(at.matrix, rows.rows, n, at.work, lumped);
        if (blueprint.normalise && solved.regular) {
            solved.condition = condition_before_scaling(at.matrix, n, at.work);
            if (margin) beyond_noise = normalised_rows_rise_above(at.matrix, n, at.work, blueprint.margin_over_noise, at.noise, at.sums, square_of_noise);
        }
    } else {
        const S* const slot = memory.published + then.slot * slot_scalars(blueprint);
        for (int k = 0; k < size; ++k) at.sums[k] = slot[k];
        for (int k = 0; k < point_noise_scalars(n, groups); ++k) at.noise[k] = slot[size + k];
        if (pushes_since(*memory.progress, then) >= static_cast<std::uint32_t>(published_slots)) return {false, Status::filling, none};
        if (blueprint.noise_floor.size > 0) beyond_noise = rises_above(at.sums, blueprint.noise_floor.data, n, at.work);
        solved = blueprint.solve == Solve::robust          ? solve_gram(at.sums, n, at.work, lumped)
                 : blueprint.solve == Solve::least_squares ? solve_triangle(at.sums, n, at.work, lumped)
                                                           : eliminate(blueprint.elimination, at.sums, n, at.work, lumped, NoiseMargin<S>{at.noise, blueprint.margin_over_noise, &excess});
        if (groups > 0 && blueprint.solve == Solve::least_squares && solved.regular) {
            excess = residual_excess(at.noise[group_place(n, 0) + 1], expected_residuals(at.noise, n, 0, 0, n, lumped));
            beyond_noise = above_noise(at.sums, n, blueprint.margin_over_noise * excess, at.noise, square_of_noise);
        }
    }
    bool good = solved.regular && solved.condition <= blueprint.condition_limit && beyond_noise;
    if (filters) {   // what solve_gram leaves in its scratch: L and D, then the scales
        if (!good) filter_nothing(blueprint.ratio, memory.ratio, n);
        good = good && filter_ratio(blueprint.ratio, memory.ratio, at.work, n + 1, at.work + n * n, n, lumped);
    }
    if (good && limited && groups > 0) {
        S* const covariance = scratch + point_uncertainty_scratch(blueprint);
        propagate_all_points(blueprint, memory, scratch, excess, lumped, covariance, static_cast<S*>(nullptr));
        if (pushes_since(*memory.progress, then) > 0U) return {false, Status::filling, none};
        good = certain_enough(blueprint, covariance, lumped);
    } else if (good && limited) {
        S* const covariance = scratch + uncertainty_scratch(rows.rows, n, blueprint.solve == Solve::robust ? blueprint.solve_instants : 0);
        good = propagate(blueprint, memory, then, scratch, lumped, covariance, static_cast<S*>(nullptr)) &&
               certain_enough(blueprint, covariance, lumped);
    }
    if (good && perturbed) perturbation_of(blueprint, memory, then, at.matrix, lumped, lumped + n);
    if ((limited || perturbed) && overtaken(blueprint, memory, then)) return {false, Status::filling, none};
    return {true, good ? Status::ok : Status::singular, solved.condition};
}

}  // namespace detail

/// Solves with the newest windows; `lumped` (unknowns entries, then the perturbation's; with elimination the parameters instead) is of use with
/// status ok alone.
/// scratch: estimate_scratch; with a deviation limit uncertainty_scratch and packed_size(unknowns) more.
/// Cost: square: all dot products and one solve; else one solve; a perturbation's dot products; whitened rows: residual_factor; a deviation
/// limit: that of uncertainty. With a ratio filter call it once per push. Never fails, fixed loops.
template <class S>
[[gnu::always_inline]] inline Latest<S> estimate(const Blueprint<S>& blueprint, Memory<S> memory, S* scratch, S* lumped) noexcept {
    Progress then;
    S excess = S(1);
    const Latest<S> latest = detail::estimate_at(blueprint, memory, scratch, lumped, then, false, excess);
    if (latest.current && latest.status == Status::ok) {
        for (int u = 0; u < blueprint.whiten_at.size; ++u) memory.whitened_at[u] = lumped[u];
    }
    return latest;
}

/// Solves with the newest windows as estimate does (a ratio filter aside, which stays where it is), and says how noise moves the solution: its
/// covariance (packed upper triangle) and bias (unknowns; with an elimination of the parameters). Needs declared noise; square, robust and operating
/// points. Written only with status ok. scratch: uncertainty_scratch; of operating points point_uncertainty_scratch. Cost: propagate_noise, and the rows of
/// up to 32 instants; of operating points propagate_points_cost. Never fails, fixed loops.
template <class S>
[[gnu::always_inline]] inline Latest<S> uncertainty(const Blueprint<S>& blueprint, Memory<S> memory, S* scratch, S* lumped, S* covariance, S* bias) noexcept {
    Progress then;
    S excess = S(1);
    Latest<S> latest = detail::estimate_at(blueprint, memory, scratch, lumped, then, true, excess);
    if (!latest.current || latest.status != Status::ok) return latest;
    if (blueprint.points.groups > 0) {
        detail::propagate_all_points(blueprint, memory, scratch, excess, lumped, covariance, bias);
        if (detail::pushes_since(*memory.progress, then) > 0U) return {false, Status::filling, std::numeric_limits<S>::infinity()};
        return latest;
    }
    if (!detail::propagate(blueprint, memory, then, scratch, lumped, covariance, bias)) latest.status = Status::singular;
    if (detail::pushes_since(*memory.progress, then) > static_cast<std::uint32_t>(spare_samples)) return {false, Status::filling, std::numeric_limits<S>::infinity()};
    return latest;
}

}  // namespace algest
