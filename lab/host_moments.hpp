// SPDX-License-Identifier: GPL-3.0-or-later
// The windowed moments of an estimator that runs on the host, in the accumulators that its plan asks for.
#pragma once
#include <variant>
#include <vector>

#include "algest/moment_estimator.hpp"
#include "generator/blueprint.hpp"
#include "generator/plan.hpp"

namespace algest::lab {

/// Tables and state of one instance; S the samples' scalar, A what moments are summed in.
template <class S, class A>
struct MomentState {
    explicit MomentState(const plan::Plan& plan)
        : data(plan::make_moments<S, A>(plan)),
          accumulators(static_cast<std::size_t>(moment_accumulators<A>(plan.rings(), plan.moments->degree, plan.moments->shortest > 0))),
          references(static_cast<std::size_t>(moment_references<A>(plan.rings()))),
          sizes(references.size()),
          scratch(static_cast<std::size_t>(moment_scratch(plan.rings(), plan.moments->degree))) {}

    MomentMemory<S, A> memory() { return {accumulators.data(), references.data(), sizes.data(), &progress}; }

    plan::MomentData<S, A> data;
    std::vector<A> accumulators;
    std::vector<S> references;
    std::vector<S> sizes;
    std::vector<A> scratch;
    MomentProgress progress{};
};

/// std::monostate: engine fir.
template <class S>
using HostMoments = std::variant<std::monostate, MomentState<S, double>, MomentState<S, Twofold<S>>>;

template <class S>
HostMoments<S> host_moments(const plan::Plan& plan) {
    if (!plan.moments) return std::monostate();
    if (plan.moments->accumulators == plan::Accumulators::float64) return MomentState<S, double>(plan);
    return MomentState<S, Twofold<S>>(plan);
}

/// False, and nothing done, with engine fir.
template <class S>
bool push_moments(HostMoments<S>& moments, const Blueprint<S>& common, Memory<S> memory, const S* sample, S* scratch) {
    const auto push_into = [&]<class A>(MomentState<S, A>& m) {
        algest::push(MomentBlueprint<S, A>{common, m.data.view(), m.data.growing_view()}, memory, m.memory(), sample, scratch, m.scratch.data());
    };
    if (auto* m = std::get_if<MomentState<S, double>>(&moments)) push_into(*m);
    else if (auto* two = std::get_if<MomentState<S, Twofold<S>>>(&moments)) push_into(*two);
    else return false;
    return true;
}

template <class S>
void reset_moments(HostMoments<S>& moments) {
    if (auto* m = std::get_if<MomentState<S, double>>(&moments)) restart_moments(m->progress);
    if (auto* two = std::get_if<MomentState<S, Twofold<S>>>(&moments)) restart_moments(two->progress);
}

}  // namespace algest::lab
