// SPDX-License-Identifier: GPL-3.0-or-later
// The one place where the runtime is compiled for the host, in both scalars.
#include "lab/host_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "algest/arithmetic.hpp"
#include "generator/tape.hpp"

namespace algest::lab {

template <class S>
HostEstimator<S>::HostEstimator(const plan::Plan& plan)
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
      sums_(size(plan.points_above_noise() ? sum_scalars(blueprint_.points.view(), blueprint_.unknowns) : sum_scalars(blueprint_.solve, blueprint_.unknowns, blueprint_.solve_instants))),
      published_(size(plan.moments ? published_row_scalars(blueprint_.solve, blueprint_.rows.rows, blueprint_.unknowns, blueprint_.perturbation.rows)
                   : plan.points_above_noise() ? published_scalars(blueprint_.points.view(), blueprint_.unknowns)
                                               : published_scalars(blueprint_.solve, blueprint_.unknowns))),
      whitened_at_(blueprint_.whiten_at),
      ratio_(size(ratio_scalars(blueprint_.ratio.used, blueprint_.unknowns))),
      boxcar_(size(boxcar_scalars(blueprint_.signals))),
      means_(size(blueprint_.signals)),
      push_scratch_(size(push_scratch(std::max(blueprint_.rows.rows, blueprint_.perturbation.rows), blueprint_.unknowns) + all_change_products(blueprint_.points.view()))),
      estimate_scratch_(size(uncertainty_scratch(std::max(blueprint_.rows.rows, blueprint_.perturbation.rows), blueprint_.unknowns,
                                                 plan.solve_instants) +
                             above_noise_scratch(blueprint_.unknowns) + point_uncertainty_scratch(blueprint_.view()) +
                             packed_size(point_parameters(blueprint_.elimination.view(), blueprint_.unknowns)))),
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
      covariance_(size(packed_size(point_parameters(blueprint_.elimination.view(), blueprint_.unknowns)))),
      lumped_bias_(size(point_parameters(blueprint_.elimination.view(), blueprint_.unknowns))),
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

template <class S>
void HostEstimator<S>::reset() {
    if (plan_->points_above_noise()) algest::reset_points(blueprint_.view(), memory());
    else algest::reset(blueprint_.view(), memory());
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

template <class S>
void HostEstimator<S>::push(const S* newest_sample) {
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

template <class S>
Status HostEstimator<S>::estimate() {
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

template <class S>
Status HostEstimator<S>::step(const S* inputs) {
    push(inputs);
    return estimate();
}

template <class S>
Status HostEstimator<S>::uncertainty() {
    const Latest<S> latest = algest::uncertainty(blueprint_.view(), memory(), estimate_scratch_.data(), lumped_.data(), covariance_.data(), lumped_bias_.data());
    if (!latest.current || latest.status != Status::ok) return latest.status;
    const int n = blueprint_.unknowns;
    if (plan_->elimination) {   // it was solved for the parameters themselves
        for (int p = 0; p < plan_->estimated(); ++p) {
            deviation_[size(p)] = std::sqrt(covariance_[size(packed_index(plan_->estimated(), p, p))]);
            bias_[size(p)] = lumped_bias_[size(p)];
        }
        return Status::ok;
    }
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

template <class S>
std::vector<Candidate<double>> HostEstimator<S>::candidates() {
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

template <class S>
bool HostEstimator<S>::align(const S* newest_sample) {
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

template <class S>
bool HostEstimator<S>::average_point(const S* inputs) {
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

template <class S>
bool HostEstimator<S>::acceptable(const S* inputs) const {
    for (std::size_t i = 0; i < plan_->inputs.size(); ++i) {
        const plan::Input& input = plan_->inputs[i];
        if (!all_finite(inputs + i, 1)) return false;
        if (!within(inputs[i], static_cast<S>(input.min), static_cast<S>(input.max))) return false;
    }
    return true;
}

template <class S>
bool HostEstimator<S>::look_back(const S* inputs) {
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

template <class S>
void HostEstimator<S>::differentiate(const S* inputs) {
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

template <class S>
void HostEstimator<S>::remember(const S* inputs) {
    for (std::size_t i = 0; i < previous_.size(); ++i) previous_[i] = inputs[i];
}

template <class S>
void HostEstimator<S>::absorb(const S* sample) {
    if (push_moments(moments_, blueprint_.view(), memory(), sample, push_scratch_.data())) return;
    if (plan_->points_above_noise()) algest::push_point(blueprint_.view(), memory(), sample, push_scratch_.data());
    else algest::push(blueprint_.view(), memory(), sample, push_scratch_.data());
}

template <class S>
void HostEstimator<S>::refuse() {
    absorb(nullptr);
    waited_ = 0;
    run_ = 0;
    block_ = {};
    point_ = {};
    delay_ = {};
}

template <class S>
bool HostEstimator<S>::map_parameters() {
    plan::evaluate<S>(plan_->parameter_map, lumped_.data(), nullptr, nullptr, map_values_.data(), mapped_.data());
    if (!all_finite(mapped_.data(), static_cast<int>(mapped_.size()))) return false;
    parameters_ = mapped_;
    return true;
}

template class HostEstimator<float>;
template class HostEstimator<double>;

}  // namespace algest::lab
