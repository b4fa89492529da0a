// SPDX-License-Identifier: GPL-3.0-or-later
// A plan run sample by sample on the host, with the runtime code and in the order of operations of the generated class:
// the two agree to the last bit in the same scalar.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "algest/boxcar.hpp"
#include "algest/delay_line.hpp"
#include "algest/estimator.hpp"
#include "algest/parabola_filter.hpp"
#include "algest/steady_state.hpp"
#include "generator/blueprint.hpp"
#include "generator/plan.hpp"
#include "lab/host_moments.hpp"

namespace algest::lab {

/// One estimator instance of a plan in scalar S (float or double). Keeps a reference: the plan must live longer.
/// Memory: the windows of all signals twice, the sums of the solve, one scalar per operation of the plan's formulas.
/// Compiled once, in host_estimator.cpp.
template <class S>
class HostEstimator {
public:
    explicit HostEstimator(const plan::Plan& plan);

    /// Forgets everything; the parameters are their initial values again.
    void reset();

    /// Takes one sample: plan.inputs values, in the plan's units. Total: every input is answered.
    /// Cost: that of the runtime's push, and one operation per entry of the signals' tape.
    void push(const S* newest_sample);

    /// Solves with the windows as they are now. Cost: that of the runtime's estimate, and the parameter map.
    Status estimate();

    /// push, then estimate.
    Status step(const S* inputs);

    /// What the declared noise does to the estimate of the windows as they are now: the status of that estimate; ok: deviation() and
    /// bias() are new, else they are as they were. Cost: that of the runtime's uncertainty.
    Status uncertainty();
    /// Standard deviation of each estimated parameter, in its unit; one per plan.parameters, perturbations have none and stay 0.
    const std::vector<S>& deviation() const { return deviation_; }
    /// Expected estimate minus truth, to the second order of the noise; likewise.
    const std::vector<S>& bias() const { return bias_; }

    Status status() const { return status_; }
    /// Operating points since the start, and the means of the newest: one per plan.steady->averaged.
    std::size_t points() const { return points_; }
    const std::vector<S>& point() const { return point_means_; }
    /// Every candidate of an elimination with the rows as they are now, stage after stage. Cost: that of estimate.
    std::vector<Candidate<double>> candidates();
    /// Of the scaled matrix that was solved last; infinity unless the status is ok or singular.
    S condition() const { return condition_; }
    /// One per plan.parameters, in its unit: of the last ok step, else the initial values.
    const std::vector<S>& parameters() const { return parameters_; }

private:
    static constexpr std::uint32_t never = 1;   ///< no sequence at rest is odd
    static constexpr int most_candidates = 200;

    static std::size_t size(int count) { return static_cast<std::size_t>(count); }

    Memory<S> memory() { return {rings_.data(), sums_.data(), published_.data(), &progress_, whitened_at_.data(), ratio_.data()}; }

    /// Puts the values of one instant into aligned_: each input's of as many samples ago as it waits. False while there are too few.
    bool align(const S* newest_sample);

    /// Takes a sample into the block; true when it ends a steady one, whose means are then the newest operating point.
    bool average_point(const S* inputs);

    /// True when every input is finite and inside its declared limits.
    bool acceptable(const S* inputs) const;

    /// Sets all_inputs_ to the inputs and their past, and keeps the inputs; false until the lines are full.
    bool look_back(const S* inputs);

    /// Moves the parabola filters by one sample; they then stand at the sample before the newest.
    void differentiate(const S* inputs);

    void remember(const S* inputs);

    /// Into the windows of the plan's engine; nullptr: a refused sample.
    void absorb(const S* sample);

    /// Windows, filters and the memory of the sample before start anew.
    void refuse();

    /// Lumped -> parameters; false, and the parameters as they were, if one is not finite.
    bool map_parameters();

    const plan::Plan* plan_;
    plan::BlueprintData<S> blueprint_;
    bool delayed_;
    std::vector<int> lines_of_;    ///< inputs that have a delay line
    int delay_length_;
    std::vector<S> lines_;
    std::vector<S> newest_;
    std::vector<S> all_inputs_;    ///< inputs, then past ones
    DelayProgress delay_{};
    int run_ = 0;  ///< delayed plans: samples accepted since the last restart, at most 2
    Progress progress_{};
    HostMoments<S> moments_;
    std::vector<S> rings_;
    std::vector<S> sums_;
    std::vector<S> published_;
    std::vector<S> whitened_at_;
    std::vector<S> ratio_;
    std::vector<S> boxcar_;
    std::vector<S> means_;
    std::vector<unsigned char> held_;
    BoxcarProgress block_{};
    SteadyProgress point_{};
    std::uint32_t solved_ = never;
    std::size_t points_ = 0;
    std::vector<S> tolerance_;
    std::vector<S> steady_;
    std::vector<S> quantity_values_;
    std::vector<S> quantities_;
    std::vector<S> point_means_;
    std::vector<S> push_scratch_;
    std::vector<S> estimate_scratch_;
    std::vector<S> waiting_;   ///< the newest samples, a ring
    std::vector<S> aligned_;
    int waiting_at_ = 0;       ///< where the next sample goes
    int waited_ = 0;           ///< samples since the last restart, at most the longest wait
    std::vector<S> previous_;
    std::vector<ParabolaFilter<S>> filters_;
    std::vector<S> derivatives_;  ///< per second
    std::vector<S> signal_values_;
    std::vector<S> signals_;
    std::vector<S> lumped_;
    std::vector<S> map_values_;
    std::vector<S> mapped_;
    std::vector<S> parameters_;
    std::vector<S> covariance_;
    std::vector<S> lumped_bias_;
    std::vector<S> derivative_values_;
    std::vector<S> map_derivatives_;
    std::vector<S> deviation_;
    std::vector<S> bias_;
    Status status_ = Status::filling;
    S condition_ = std::numeric_limits<S>::infinity();
};

}  // namespace algest::lab
