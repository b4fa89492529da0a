// SPDX-License-Identifier: MIT-0
// The estimator behind every generated class and every replay: samples -> windows -> rows -> solve.
//
// One producer calls push (an interrupt, say), one consumer calls estimate (the background). The consumer copies what it
// needs under a sequence counter, and reads window samples that the producer does not touch for spare_samples more pushes.
// Copies that a push has spoilt are thrown away; C++ still calls such reads a data race, and ThreadSanitizer reports them.
#pragma once
#include <cstdint>

#include "algest/abi.hpp"
#include "algest/arithmetic.hpp"
#include "algest/gram_window.hpp"
#include "algest/rows.hpp"
#include "algest/solve_gram.hpp"
#include "algest/solve_rows.hpp"
#include "algest/status.hpp"
#include "algest/triangle_update.hpp"
#include "algest/window.hpp"

namespace algest {

enum class Solve : std::uint8_t {
    square,         ///< the rows of the newest instant alone, solved in estimate()
    robust,         ///< S(t) over the last solve_instants instants, summed in push()
    least_squares   ///< every row since reset, absorbed in push()
};

/// An estimator as constant data, shared by all its instances.
template <class S>
struct Blueprint {
    RowSet<S> rows;
    Solve solve;
    int solve_instants;   ///< robust: instants in S(t)
    S keep;               ///< least_squares: factor on the old triangle at each instant; 1 forgets nothing
    S condition_limit;    ///< above it an estimate is singular
};

/// Pushes that may fall into one estimate() of a square estimator without spoiling it.
constexpr int spare_samples = 8;
/// Copies of the sums that push() publishes in turn.
constexpr int published_slots = 4;

constexpr int ring_length(Solve solve, int samples) noexcept {
    return solve == Solve::square ? samples + spare_samples : samples;
}
constexpr int sum_scalars(Solve solve, int unknowns, int instants) noexcept {
    return solve == Solve::square   ? 1
           : solve == Solve::robust ? gram_scalars(unknowns, instants)
                                    : triangle_scalars(unknowns);
}
constexpr int published_scalars(Solve solve, int unknowns) noexcept {
    return solve == Solve::square ? 1 : published_slots * packed_size(unknowns + 1);
}
/// Scalars of scratch that push needs.
constexpr int push_scratch(int rows, int unknowns) noexcept { return rows * (unknowns + 1); }
/// Scalars of scratch that estimate needs.
constexpr int estimate_scratch(int rows, int unknowns) noexcept {
    int most = solve_rows_scratch(unknowns);
    if (solve_gram_scratch(unknowns) > most) most = solve_gram_scratch(unknowns);
    if (solve_triangle_scratch(unknowns) > most) most = solve_triangle_scratch(unknowns);
    return rows * (unknowns + 1) + packed_size(unknowns + 1) + most;
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

}  // namespace detail

/// Forgets everything. Call it while neither push nor estimate runs.
template <class S>
inline void reset(const Blueprint<S>& blueprint, Memory<S> memory) noexcept {
    *memory.progress = Progress{};
    if (blueprint.solve == Solve::robust) clear_gram(memory.sums, memory.progress->gram, blueprint.rows.unknowns);
    if (blueprint.solve == Solve::least_squares) {
        for (int i = 0; i < triangle_scalars(blueprint.rows.unknowns); ++i) memory.sums[i] = S(0);
    }
}

/// Takes one sample of every signal; nullptr says that the newest sample was refused: the windows and S(t) restart,
/// the rows that least_squares absorbed so far stay. Cost: square: one store per signal; else one evaluation of all rows and
/// their absorption. Never fails.
template <class S>
inline void push(const Blueprint<S>& blueprint, Memory<S> memory, const S* sample, S* scratch) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    Progress& p = *memory.progress;
    const int length = ring_length(blueprint.solve, rows.samples);
    detail::begin_write(p);
    if (sample == nullptr) {
        p.filled = 0;
        p.rejected = 1;
        if (blueprint.solve == Solve::robust) {
            clear_gram(memory.sums, p.gram, rows.unknowns);
            p.absorbed = 0;
        }
        detail::end_write(p);
        return;
    }
    p.rejected = 0;
    write_sample(memory.rings, rows.signals, length, p.head, sample);
    p.head = p.head + 1 == length ? 0 : p.head + 1;
    if (p.filled < rows.samples) ++p.filled;
    if (blueprint.solve != Solve::square && p.filled == rows.samples) {
        evaluate_rows(rows, memory.rings, newest(rows.samples, length, p.head), scratch);
        if (!all_finite(scratch, push_scratch(rows.rows, rows.unknowns))) {
            // Rows that overflow are left out: the sums would not recover from them.
        } else if (blueprint.solve == Solve::robust) {
            add_instant(memory.sums, p.gram, scratch, rows.rows, rows.unknowns, blueprint.solve_instants);
            p.absorbed = gram_is_full(p.gram, blueprint.solve_instants) ? 1U : 0U;
        } else {
            add_rows(memory.sums, scratch, rows.rows, rows.unknowns, blueprint.keep);
            p.absorbed = 1;
        }
        p.slot = p.slot + 1 == published_slots ? 0 : p.slot + 1;
        const int size = packed_size(rows.unknowns + 1);
        for (int k = 0; k < size; ++k) memory.published[p.slot * size + k] = memory.sums[k];
    }
    detail::end_write(p);
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

/// Solves with the newest windows; writes `lumped` (unknowns entries) only with status ok.
/// Cost: square: all dot products and one solve; else one solve. Never fails, fixed loops.
template <class S>
inline Latest<S> estimate(const Blueprint<S>& blueprint, Memory<S> memory, S* scratch, S* lumped) noexcept {
    const RowSet<S>& rows = blueprint.rows;
    const S none = std::numeric_limits<S>::infinity();
    Progress then;
    if (!detail::copy_progress(*memory.progress, then)) return {false, Status::filling, none};
    if (then.rejected != 0U) return {true, Status::rejected, none};
    if (then.filled < rows.samples) return {true, Status::filling, none};

    const int entries = rows.rows * (rows.unknowns + 1);
    const int size = packed_size(rows.unknowns + 1);
    S* matrix = scratch;
    S* sums = scratch + entries;
    S* work = sums + size;
    Solved<S> solved;
    if (blueprint.solve == Solve::square) {
        const int length = ring_length(blueprint.solve, rows.samples);
        evaluate_rows(rows, memory.rings, newest(rows.samples, length, then.head), matrix);
        if (detail::pushes_since(*memory.progress, then) > static_cast<std::uint32_t>(spare_samples)) {
            return {false, Status::filling, none};
        }
        solved = solve_rows(matrix, rows.rows, rows.unknowns, work, lumped);
    } else {
        if (then.absorbed == 0U) return {true, Status::filling, none};
        for (int k = 0; k < size; ++k) sums[k] = memory.published[then.slot * size + k];
        if (detail::pushes_since(*memory.progress, then) >= static_cast<std::uint32_t>(published_slots)) {
            return {false, Status::filling, none};
        }
        solved = blueprint.solve == Solve::robust ? solve_gram(sums, rows.unknowns, work, lumped)
                                                  : solve_triangle(sums, rows.unknowns, work, lumped);
    }
    const bool good = solved.regular && solved.condition <= blueprint.condition_limit;
    return {true, good ? Status::ok : Status::singular, solved.condition};
}

}  // namespace algest
