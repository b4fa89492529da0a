// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace algest::lab {

namespace {

std::vector<double> inputs_with(const OdeSystem& system, const std::vector<double>& parameters) {
    std::vector<double> out(static_cast<std::size_t>(system.inputs), 0.0);
    std::copy(parameters.begin(), parameters.end(), out.begin() + system.parameter_input);
    return out;
}

double result_of(BoundTape& tape) {
    double result = 0;
    tape.evaluate(&result);
    return result;
}

}  // namespace

Motion::Motion(const OdeSystem& system, const std::vector<double>& parameters)
    : system_(system), inputs_(inputs_with(system, parameters)), equations_(bound(system.residual)), results_(system.residual.results.size()),
      mass_(static_cast<Eigen::Index>(system.moving.size()), static_cast<Eigen::Index>(system.moving.size())),
      residual_(static_cast<Eigen::Index>(system.moving.size())), highest_(static_cast<Eigen::Index>(system.moving.size())) {
    for (const Output& output : system.outputs) outputs_.push_back(bound(output.tape));
    for (const Law& law : system.laws) laws_.push_back(bound(law.tape));
    for (const StateEntry& entry : system.states) entry_input_.push_back(input_of(entry));
}

std::size_t Motion::input_of(const StateEntry& entry) const {
    if (entry.order == 0) return static_cast<std::size_t>(entry.signal);
    const auto m = static_cast<std::size_t>(std::find(system_.moving.begin(), system_.moving.end(), entry.signal) - system_.moving.begin());
    return static_cast<std::size_t>(system_.derivative_input[m][static_cast<std::size_t>(entry.order) - 1]);
}

BoundTape Motion::bound(const plan::Tape& tape) const {
    std::vector<bool> fixed(inputs_.size(), false);
    std::fill(fixed.begin() + system_.parameter_input, fixed.begin() + system_.delay_input, true);   // those of the parameters
    return BoundTape(tape, inputs_, fixed);
}

bool Motion::show() {
    bool finite = true;
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
        const double shown = result_of(outputs_[o]);
        input(system_.outputs[o].signal) = std::isfinite(shown) ? shown : 0.0;
        finite = finite && std::isfinite(shown);
    }
    return finite;
}

bool Motion::show_and_control() {
    const bool finite = show();
    for (std::size_t l = 0; l < laws_.size(); ++l) input(system_.laws[l].signal) = result_of(laws_[l]);
    return laws_.empty() ? finite : show() && finite;
}

void Motion::evaluate() {
    ++evaluations_;
    equations_.evaluate(results_.data());
}

/// Highest derivatives at the present inputs and relays: residual = r0 + mass * h = 0.
const Eigen::VectorXd& Motion::highest() {
    const Eigen::Index count = highest_.size();
    const auto highest_input = [&](Eigen::Index m) -> double& { return input(system_.derivative_input[static_cast<std::size_t>(m)].back()); };
    for (Eigen::Index m = 0; m < count; ++m) highest_input(m) = 0.0;
    evaluate();
    std::copy_n(results_.begin(), count, residual_.data());
    if (!inverted_ || !system_.constant_mass) {
        for (Eigen::Index m = 0; m < count; ++m) {
            highest_input(m) = 1.0;
            evaluate();
            for (Eigen::Index e = 0; e < count; ++e) mass_(e, m) = argument(static_cast<int>(e)) - residual_[e];
            highest_input(m) = 0.0;
        }
        inverse_ = mass_.inverse();
        inverted_ = true;
    }
    for (Eigen::Index m = 0; m < count; ++m) {   // a few numbers, a million times: Eigen takes longer to see how few
        double sum = 0;
        for (Eigen::Index e = 0; e < count; ++e) sum += inverse_(m, e) * residual_[e];
        highest_[m] = -sum;
    }
    return highest_;
}

void Motion::rate(State& out) {
    const Eigen::VectorXd& h = highest();
    std::size_t i = 0;
    for (std::size_t m = 0; m < system_.moving.size(); ++m) {
        for (int order = 0; order < system_.highest[m]; ++order, ++i) {
            out[i] = order + 1 < system_.highest[m] ? input(system_.derivative_input[m][static_cast<std::size_t>(order)]) : h[static_cast<Eigen::Index>(m)];
        }
    }
}

double Motion::argument_rate(std::size_t r, const State& x, const std::vector<double>& scale) {
    State slope(x.size());
    set_state(x);
    rate(slope);
    evaluate();
    const int result = system_.relays[r].argument;
    const double here = argument(result);
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(slope[i]) / scale[i]);
    if (!(largest > 0)) return 0.0;
    const double h = 1e-7 / largest;
    State ahead = x;
    for (std::size_t i = 0; i < x.size(); ++i) ahead[i] += h * slope[i];
    set_state(ahead);
    evaluate();
    const double there = argument(result);
    set_state(x);
    return (there - here) / h;
}

double Motion::holding_value(std::size_t r, const State& x, const std::vector<double>& scale) {
    relay(r) = 1.0;
    const double up = argument_rate(r, x, scale);
    relay(r) = -1.0;
    const double down = argument_rate(r, x, scale);
    // The argument's rate is linear in the relay: down + (value + 1) (up - down) / 2.
    return up == down ? 0.0 : -(up + down) / (up - down);
}

}  // namespace algest::lab
