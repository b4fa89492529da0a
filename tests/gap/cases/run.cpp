// SPDX-License-Identifier: GPL-3.0-or-later
#include "run.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <algorithm>
#include <cmath>

#include "rounding.hpp"

namespace algest::gap {

namespace {

namespace odeint = boost::numeric::odeint;

/// The right side over states divided by their scale, so that one tolerance serves all; own states of effects follow the system's.
class Motion {
public:
    explicit Motion(const Machine& machine)
        : machine_(machine),
          count_(machine.system->initial.size()),
          x_(count_),
          rate_(count_),
          added_(machine.system->slots.size()) {}

    void at(std::size_t sample, const std::vector<std::vector<double>>& commanded) {
        sample_ = sample;
        start_ = static_cast<double>(sample) * machine_.system->period;
        commanded_ = &commanded;
        u_ = commanded.back();
    }

    void operator()(const State& z, State& dz, double t) {
        for (std::size_t i = 0; i < count_; ++i) x_[i] = z[i] * machine_.scale[i];
        for (std::size_t s = 0; s < added_.size(); ++s)
            added_[s] = machine_.process_noise.empty() || machine_.process_noise[s].empty()
                            ? 0.0
                            : machine_.process_noise[s][sample_];
        std::size_t own = count_;
        for (const Effect& e : machine_.effects) {
            for (std::size_t w = 0; w < e.inputs.size(); ++w) {
                u_[static_cast<std::size_t>(e.inputs[w])] =
                    e.arrives(w, *commanded_, sample_, z.data() + own, e.values.data());
            }
            own += e.own.size();
        }
        own = count_;
        for (const Effect& e : machine_.effects) {
            for (std::size_t w = 0; w < e.slots.size(); ++w) {
                added_[static_cast<std::size_t>(e.slots[w])] +=
                    e.term(w, x_.data(), u_.data(), start_ + t, z.data() + own, e.values.data());
            }
            if (e.own_rate)
                e.own_rate(x_.data(), commanded_->back().data(), z.data() + own, e.values.data(), dz.data() + own);
            own += e.own.size();
        }
        machine_.system->rate(x_.data(), u_.data(), machine_.p.data(), added_.data(), rate_.data());
        for (std::size_t i = 0; i < count_; ++i) dz[i] = rate_[i] / machine_.scale[i];
    }

private:
    const Machine& machine_;
    std::size_t count_, sample_ = 0;
    double start_ = 0;
    State x_, rate_, added_;
    std::vector<double> u_;  ///< as they arrive
    const std::vector<std::vector<double>>* commanded_ = nullptr;
};

/// One sample ahead; false where it diverges.
template <class Stepper>
bool advance(Stepper& stepper, Motion& motion, State& z, double period, double& step) {
    stepper.reset();  // inputs jump here: what the last step left at its end is stale
    double t = 0;
    for (int steps = 0; period - t > 1e-12 * period; ++steps) {
        if (steps > 20000) return false;
        double h = std::min(step, period - t);
        const bool whole = h == step;
        const auto result = stepper.try_step(std::ref(motion), z, t, h);
        if (result == odeint::success && !whole) continue;  // cut short by the sample: says nothing about the step
        step = h;
    }
    for (const double v : z) {
        if (!(std::abs(v) < 1e4)) return false;
    }
    return true;
}

Run run(const Machine& machine, const std::vector<std::vector<double>>* replayed) {
    const System& system = *machine.system;
    Run out;
    State z;
    for (std::size_t i = 0; i < system.initial.size(); ++i) z.push_back(system.initial[i] / machine.scale[i]);
    for (const Effect& e : machine.effects) z.insert(z.end(), e.own.begin(), e.own.end());
    Motion motion(machine);
    auto stepper = odeint::make_controlled(1e-8, 1e-8, odeint::runge_kutta_dopri5<State>());
    Controller controller;
    if (!replayed) controller = system.experiment();
    double step = system.period;
    State x(system.initial.size());
    std::vector<double> u(system.inputs.size());
    for (std::size_t k = 0; k < system.samples(); ++k) {
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = z[i] * machine.scale[i];
        if (replayed)
            u = (*replayed)[k];
        else
            controller(k, x, u);
        if (!replayed) {
            for (double& v : u) v = rounded(v, 7);
        }
        // The law is computed with what the recording holds of its other inputs; the amplifier has no rounding.
        if (system.feedback)
            u[static_cast<std::size_t>(system.feedback->input)] =
                system.feedback->value(x.data(), u.data(), machine.p.data());
        out.states.push_back(x);
        out.inputs.push_back(u);
        motion.at(k, out.inputs);
        if (!advance(stepper, motion, z, system.period, step)) {
            out.finite = false;
            break;
        }
    }
    return out;
}

}  // namespace

Run record(const Machine& machine) { return run(machine, nullptr); }
Run replay(const Machine& machine, const std::vector<std::vector<double>>& inputs) { return run(machine, &inputs); }

}  // namespace algest::gap
