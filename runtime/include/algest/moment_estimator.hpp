// SPDX-License-Identifier: MIT-0
// The estimator on windowed moments: samples -> moments -> rows -> the sums that estimator.hpp solves. estimate() is that of estimator.hpp.
#pragma once
#include <type_traits>

#include "algest/estimator.hpp"
#include "algest/growing_moments.hpp"
#include "algest/moments.hpp"

namespace algest {

/// An estimator as constant data. A: what moments are summed in, double or Twofold<S>.
template <class S, class A>
struct MomentBlueprint {
    Blueprint<S> common;   ///< without tables; kept == 0, rows_published
    MomentSet<S, A> moments;
    GrowingSet growing;    ///< A double; no tables: windows do not grow
};

namespace detail {

/// Hands the rows of the newest instant on (destroyed): to the sums, or published as they are where they are solved alone. Where the published
/// copy goes on behind them.
template <class S>
inline S* hand_on(const Blueprint<S>& blueprint, Memory<S> memory, S* matrix) noexcept {
    if (blueprint.solve != Solve::square) return absorb<false>(blueprint, memory, matrix);
    S* const slot = next_slot(blueprint, memory);
    const int entries = row_entries(blueprint.rows.rows, blueprint.rows.unknowns);
    for (int i = 0; i < entries; ++i) slot[i] = matrix[i];
    return slot + entries;
}

/// The rows of the newest window: a full one, or one that grows.
template <class S, class A>
inline void evaluate_newest(const MomentBlueprint<S, A>& blueprint, int filled, MomentMemory<S, A> moments, const S* oldest, const S* newest, A* scratch, RowSums<S> to) noexcept {
    const RowSet<S>& rows = blueprint.common.rows;
    if constexpr (std::is_same<A, double>::value) {
        if (filled < rows.samples) {
            evaluate_growing_rows(blueprint.growing, blueprint.moments, rows, moments, newest, scratch, to);
            return;
        }
    }
    evaluate_moment_rows(blueprint.moments, rows, moments, oldest, newest, scratch, to);
}

}  // namespace detail

/// Forgets everything. Call it while neither push nor estimate runs.
template <class S, class A>
inline void reset(const MomentBlueprint<S, A>& blueprint, Memory<S> memory, MomentMemory<S, A> moments) noexcept {
    reset(blueprint.common, memory);
    restart_moments(*moments.progress);
}

/// Takes one sample of every signal; nullptr says that the newest sample was refused, as for the windows of estimator.hpp. The rings hold the
/// samples of one window, signal after signal in each. scratch: push_scratch; moment_scratch.
/// Cost: add_sample, and once the window is full evaluate_moment_rows and the absorption of the rows. Never fails.
template <class S, class A>
inline void push(const MomentBlueprint<S, A>& blueprint, Memory<S> memory, MomentMemory<S, A> moments, const S* sample, S* scratch,
                 A* moment_scratch) noexcept {
    const Blueprint<S>& common = blueprint.common;
    const RowSet<S>& rows = common.rows;
    Progress& p = *memory.progress;
    detail::begin_write(p);
    if (sample == nullptr) {
        detail::refuse(common, memory);
        restart_moments(*moments.progress);
        detail::end_write(p);
        return;
    }
    p.rejected = 0;
    S* const slot = memory.rings + p.head * rows.signals;
    add_sample(blueprint.moments, rows.samples - 1, moments, sample, slot, moment_scratch);
    if constexpr (std::is_same<A, double>::value) {
        if (blueprint.growing.tables() > 0 && p.filled < rows.samples) add_growing_sample(blueprint.moments, moments, sample, moment_scratch);
    }
    for (int s = 0; s < rows.signals; ++s) slot[s] = sample[s];
    p.head = p.head + 1 == rows.samples ? 0 : p.head + 1;
    if (p.filled < rows.samples) ++p.filled;
    if (p.filled >= common.needed()) {
        const S* const oldest = memory.rings + p.head * rows.signals;
        detail::evaluate_newest(blueprint, p.filled, moments, oldest, sample, moment_scratch, {scratch, scratch + row_entries(rows.rows, rows.unknowns)});
        S* const behind = detail::hand_on(common, memory, scratch);
        if (common.perturbation.rows > 0) evaluate_moment_rows(blueprint.moments, common.perturbation, moments, oldest, sample, moment_scratch, {behind, scratch});
    }
    detail::end_write(p);
}

}  // namespace algest
