// SPDX-License-Identifier: GPL-3.0-or-later
// A plan run sample by sample on the host, with the runtime code and in the order of operations of the generated class:
// the two agree to the last bit in the same scalar.
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "algest/arithmetic.hpp"
#include "algest/boxcar.hpp"
#include "algest/delay_line.hpp"
#include "algest/estimator.hpp"
#include "algest/parabola_filter.hpp"
#include "algest/steady_state.hpp"
#include "generator/blueprint.hpp"
#include "generator/plan.hpp"
#include "generator/tape.hpp"
#include "lab/host_moments.hpp"

namespace algest::lab {

/// One estimator instance of a plan in scalar S (float or double). Keeps a reference: the plan must live longer.
/// Memory: the windows of all signals twice, the sums of the solve, one scalar per operation of the plan's formulas.
template <class S>
class HostEstimator {
public:
    explicit HostEstimator(const plan::Plan& plan)
        : plan_(&plan),
          blueprint_(plan::make_blueprint<S>(plan)),
          delayed_(plan.delayed()),
          lines_of_(plan.delayed_inputs()),
          delay_length_(plan.delay_length()),
          lines_(lines_of_.size() * size(delay_length_)),
          newest_(lines_of_.size()),
          all_inputs_(plan.inputs.size() + plan.past.size()),
          moments_(host_moments<S>(plan)),
          rings_(size(plan.moments ? moment_ring(blueprint_.signals, blueprint_.samples)
                                   : ring_scalars(blueprint_.signals, ring_length(blueprint_.samples, blueprint_.kept)))),
          sums_(size(sum_scalars(blueprint_.solve, blueprint_.unknowns, blueprint_.solve_instants, plan.margin_over_noise > 0.0))),
          published_(size(plan.moments ? published_row_scalars(blueprint_.solve, blueprint_.rows.rows, blueprint_.unknowns, blueprint_.perturbation.rows)
                                       : published_scalars(blueprint_.solve, blueprint_.unknowns, plan.margin_over_noise > 0.0))),
          whitened_at_(blueprint_.whiten_at),
          ratio_(size(ratio_scalars(blueprint_.ratio.used, blueprint_.unknowns))),
          boxcar_(size(boxcar_scalars(blueprint_.signals))),
          means_(size(blueprint_.signals)),
          push_scratch_(size(push_scratch(std::max(blueprint_.rows.rows, blueprint_.perturbation.rows), blueprint_.unknowns))),
          estimate_scratch_(size(uncertainty_scratch(std::max(blueprint_.rows.rows, blueprint_.perturbation.rows), blueprint_.unknowns,
                                                     plan.solve_instants) +
                                 packed_size(blueprint_.unknowns) + above_noise_scratch(blueprint_.unknowns) + elimination_scratch(blueprint_.elimination.view()))),
          waiting_(size(plan.longest_wait() + 1) * plan.inputs.size()),
          aligned_(plan.inputs.size()),
          previous_(plan.inputs.size()),
          filters_(plan.inputs.size()),
          derivatives_(plan.inputs.size()),
          signal_values_(plan.signals.operations.size()),
          signals_(plan.signals.results.size()),
          lumped_(std::max(plan.lumped.size() + plan.perturbation.size(), plan.parameters.size())),
          map_values_(plan.parameter_map.operations.size()),
          mapped_(plan.parameter_map.results.size()),
          parameters_(plan.parameters.size()),
          covariance_(size(packed_size(blueprint_.unknowns))),
          lumped_bias_(plan.lumped.size()),
          derivative_values_(plan.map_derivatives.operations.size()),
          map_derivatives_(plan.map_derivatives.results.size()),
          deviation_(plan.parameters.size()),
          bias_(plan.parameters.size()) {
        for (const plan::WindowSignal& s : plan.window_signals) held_.push_back(s.held ? 1 : 0);
        held_.resize(size(blueprint_.signals), 0);
        if (plan.steady) {
            for (const plan::Averaged& a : plan.steady->averaged) tolerance_.push_back(static_cast<S>(a.tolerance));
            steady_.resize(size(steady_scalars(static_cast<int>(tolerance_.size()))));
            quantity_values_.resize(plan.steady->quantities.operations.size());
            quantities_.resize(tolerance_.size());
            point_means_.resize(tolerance_.size());
        }
        reset();
    }

    /// Forgets everything; the parameters are their initial values again.
    void reset() {
        algest::reset(blueprint_.view(), memory());
        reset_moments(moments_);
        run_ = 0;
        block_ = {};
        point_ = {};
        solved_ = never;
        points_ = 0;
        waiting_at_ = 0;
        waited_ = 0;
        delay_ = {};
        status_ = Status::filling;
        condition_ = std::numeric_limits<S>::infinity();
        for (std::size_t k = 0; k < parameters_.size(); ++k) parameters_[k] = static_cast<S>(plan_->parameters[k].initial);
    }

    /// Takes one sample: plan.inputs values, in the plan's units. Total: every input is answered.
    /// Cost: that of the runtime's push, and one operation per entry of the signals' tape.
    void push(const S* newest_sample) {
        if (!acceptable(newest_sample)) return refuse();
        if (!align(newest_sample)) return algest::prime(memory());
        const S* inputs = aligned_.data();
        if (!plan_->past.empty() && !look_back(inputs)) return algest::prime(memory());
        if (delayed_) {
            if (run_ == 0) {
                remember(inputs);
                run_ = 1;
                return algest::prime(memory());
            }
            differentiate(inputs);
            run_ = 2;
        }
        if (plan_->steady) {
            if (!average_point(inputs)) return;
            inputs = point_means_.data();
        }
        plan::evaluate(plan_->signals, plan_->past.empty() ? inputs : all_inputs_.data(), previous_.data(), derivatives_.data(), signal_values_.data(),
                       signals_.data());
        if (!all_finite(signals_.data(), static_cast<int>(plan_->window_signals.size()))) return refuse();
        if (delayed_) remember(inputs);
        const S* sample = signals_.data();
        if (plan_->decimate > 1) {
            const bool ends = average(boxcar_.data(), block_, held_.data(), blueprint_.signals, plan_->decimate, sample, means_.data());
            if (!ends) return algest::prime(memory());
            sample = means_.data();
        }
        absorb(sample);
    }

    /// Solves with the windows as they are now. Cost: that of the runtime's estimate, and the parameter map.
    Status estimate() {
        const std::uint32_t now = progress_.sequence;
        if (plan_->steady && now == solved_) return status_;   // no operating point since
        const Latest<S> latest = algest::estimate(blueprint_.view(), memory(), estimate_scratch_.data(), lumped_.data());
        if (!latest.current) return status_;
        solved_ = now;
        status_ = latest.status;
        condition_ = latest.condition;
        if (status_ == Status::ok && !map_parameters()) status_ = Status::singular;
        return status_;
    }

    /// push, then estimate.
    Status step(const S* inputs) {
        push(inputs);
        return estimate();
    }

    /// What the declared noise does to the estimate of the windows as they are now: the status of that estimate; ok: deviation() and
    /// bias() are new, else they are as they were. Cost: that of the runtime's uncertainty.
    Status uncertainty() {
        const Latest<S> latest = algest::uncertainty(blueprint_.view(), memory(), estimate_scratch_.data(), lumped_.data(), covariance_.data(), lumped_bias_.data());
        if (!latest.current || latest.status != Status::ok) return latest.status;
        const int n = blueprint_.unknowns;
        const std::size_t gradients = size(plan_->estimated() * n);
        plan::evaluate<S>(plan_->map_derivatives, lumped_.data(), nullptr, nullptr, derivative_values_.data(), map_derivatives_.data());
        for (int p = 0; p < plan_->estimated(); ++p) {
            const S* gradient = map_derivatives_.data() + p * n;
            const S* curvature = map_derivatives_.data() + gradients + size(p * packed_size(n));
            deviation_[size(p)] = algest::deviation(gradient, covariance_.data(), n);
            bias_[size(p)] = bias_of_function(gradient, curvature, covariance_.data(), lumped_bias_.data(), n);
        }
        return Status::ok;
    }
    /// Standard deviation of each estimated parameter, in its unit; one per plan.parameters, perturbations have none and stay 0.
    const std::vector<S>& deviation() const { return deviation_; }
    /// Expected estimate minus truth, to the second order of the noise; likewise.
    const std::vector<S>& bias() const { return bias_; }

    Status status() const { return status_; }
    /// Operating points since the start, and the means of the newest: one per plan.steady->averaged.
    std::size_t points() const { return points_; }
    const std::vector<S>& point() const { return point_means_; }
    /// Every candidate of an elimination with the rows as they are now, stage after stage. Cost: that of estimate.
    std::vector<Candidate<double>> candidates() {
        std::vector<Candidate<S>> found(most_candidates);
        CandidateList<S> list{found.data(), most_candidates, 0};
        const int columns = blueprint_.unknowns;
        if (plan_->elimination && progress_.absorbed != 0U) {
            (void)eliminate(blueprint_.elimination.view(), sums_.data(), columns, estimate_scratch_.data(), lumped_.data(), NoiseMargin<S>{nullptr, S(0)}, &list);
        }
        std::vector<Candidate<double>> out;
        for (int k = 0; k < list.count; ++k) {
            const Candidate<S>& c = found[size(k)];
            out.push_back({c.stage, static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.error), c.standing});
        }
        return out;
    }
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
    bool align(const S* newest_sample) {
        const std::size_t width = aligned_.size();
        const int longest = plan_->longest_wait();
        std::copy_n(newest_sample, width, waiting_.begin() + static_cast<std::ptrdiff_t>(size(waiting_at_) * width));
        const int now = waiting_at_;
        waiting_at_ = now == longest ? 0 : now + 1;
        if (waited_ < longest) {
            ++waited_;
            return false;
        }
        for (std::size_t i = 0; i < width; ++i) {
            const int wait = plan_->inputs[i].wait;
            aligned_[i] = waiting_[size(now >= wait ? now - wait : now + longest + 1 - wait) * width + i];
        }
        return true;
    }

    /// Takes a sample into the block; true when it ends a steady one, whose means are then the newest operating point.
    bool average_point(const S* inputs) {
        const plan::SteadyState& steady = *plan_->steady;
        plan::evaluate<S>(steady.quantities, inputs, nullptr, nullptr, quantity_values_.data(), quantities_.data());
        const int count = static_cast<int>(quantities_.size());
        if (!all_finite(quantities_.data(), count)) {
            refuse();
            return false;
        }
        const S stretch = steady.stretches < 0 ? S(1) : inputs[steady.stretches];
        if (average_steady(steady_.data(), point_, tolerance_.data(), count, steady.block, stretch, quantities_.data(), point_means_.data())) {
            ++points_;
            return true;
        }
        if (progress_.rejected != 0U) algest::prime(memory());
        return false;
    }

    /// True when every input is finite and inside its declared limits.
    bool acceptable(const S* inputs) const {
        for (std::size_t i = 0; i < plan_->inputs.size(); ++i) {
            const plan::Input& input = plan_->inputs[i];
            if (!all_finite(inputs + i, 1)) return false;
            if (!within(inputs[i], static_cast<S>(input.min), static_cast<S>(input.max))) return false;
        }
        return true;
    }

    /// Sets all_inputs_ to the inputs and their past, and keeps the inputs; false until the lines are full.
    bool look_back(const S* inputs) {
        for (std::size_t i = 0; i < lines_of_.size(); ++i) newest_[i] = inputs[lines_of_[i]];
        const bool full = delay_.filled == delay_length_;
        for (std::size_t i = 0; i < plan_->inputs.size(); ++i) all_inputs_[i] = inputs[i];
        for (std::size_t k = 0; full && k < plan_->past.size(); ++k) {
            const std::size_t line = size(static_cast<int>(std::find(lines_of_.begin(), lines_of_.end(), plan_->past[k].input) - lines_of_.begin()));
            all_inputs_[plan_->inputs.size() + k] = past_sample(lines_.data() + line * size(delay_length_), delay_length_, delay_, plan_->past[k].samples);
        }
        keep_samples(lines_.data(), static_cast<int>(lines_of_.size()), delay_length_, delay_, newest_.data());
        return full;
    }

    /// Moves the parabola filters by one sample; they then stand at the sample before the newest.
    void differentiate(const S* inputs) {
        for (std::size_t i = 0; i < filters_.size(); ++i) {
            if (!plan_->inputs[i].differentiated) continue;
            if (run_ == 1) {
                filters_[i].start(previous_[i], inputs[i]);
            } else {
                filters_[i].advance(previous_[i], inputs[i]);
            }
            derivatives_[i] = filters_[i].slope * static_cast<S>(plan_->rate);
        }
    }

    void remember(const S* inputs) {
        for (std::size_t i = 0; i < previous_.size(); ++i) previous_[i] = inputs[i];
    }

    /// Into the windows of the plan's engine; nullptr: a refused sample.
    void absorb(const S* sample) {
        if (!push_moments(moments_, blueprint_.view(), memory(), sample, push_scratch_.data())) algest::push(blueprint_.view(), memory(), sample, push_scratch_.data());
    }

    /// Windows, filters and the memory of the sample before start anew.
    void refuse() {
        absorb(nullptr);
        waited_ = 0;
        run_ = 0;
        block_ = {};
        point_ = {};
        delay_ = {};
    }

    /// Lumped -> parameters; false, and the parameters as they were, if one is not finite.
    bool map_parameters() {
        plan::evaluate<S>(plan_->parameter_map, lumped_.data(), nullptr, nullptr, map_values_.data(), mapped_.data());
        if (!all_finite(mapped_.data(), static_cast<int>(mapped_.size()))) return false;
        parameters_ = mapped_;
        return true;
    }

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
