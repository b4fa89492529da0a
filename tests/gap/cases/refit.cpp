// SPDX-License-Identifier: GPL-3.0-or-later
#include "refit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace algest::gap {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A value of the machine that a fit may move, and its size.
struct Free {
    int quantity = -1, effect = -1;
    double& in(Machine& m) const {
        return quantity >= 0 ? m.p[static_cast<std::size_t>(quantity)]
                             : m.effects[static_cast<std::size_t>(effect)].values[0];
    }
};

std::vector<Free> free_values(const Machine& machine) {
    std::vector<Free> out;
    for (std::size_t q = 0; q < machine.system->quantities.size(); ++q) {
        if (!machine.system->quantities[q].known) out.push_back({static_cast<int>(q), -1});
    }
    for (std::size_t e = 0; e < machine.effects.size(); ++e) out.push_back({-1, static_cast<int>(e)});
    return out;
}

/// (truth - model) / sigma, all outputs in a row; empty where the model diverges.
VectorXd residual(const Machine& model, const Truth& truth) {
    const Run run = replay(model, truth.inputs);
    if (!run.finite) return {};
    const auto outputs = scored(model, run);
    const auto samples = static_cast<Eigen::Index>(outputs[0].size());
    VectorXd r(samples * static_cast<Eigen::Index>(outputs.size()));
    for (std::size_t o = 0; o < outputs.size(); ++o) {
        for (Eigen::Index k = 0; k < samples; ++k) {
            const auto s = static_cast<std::size_t>(k);
            r[static_cast<Eigen::Index>(o) * samples + k] = (truth.outputs[o][s] - outputs[o][s]) / truth.sigma[o];
        }
    }
    return r;
}

/// Change of the residual for a relative change of each free value.
MatrixXd sensitivities(const Machine& model, const Truth& truth, const std::vector<Free>& free, const VectorXd& here) {
    MatrixXd J(here.size(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t f = 0; f < free.size(); ++f) {
        Machine moved = model;
        double& value = free[f].in(moved);
        value += 1e-4 * value;
        const VectorXd there = residual(moved, truth);
        J.col(static_cast<Eigen::Index>(f)) =
            there.size() == here.size() ? VectorXd((there - here) / 1e-4) : VectorXd(VectorXd::Zero(here.size()));
    }
    return J;
}

VectorXd least_squares(const MatrixXd& J, const VectorXd& r) {
    MatrixXd A = J.transpose() * J;
    A.diagonal() *= 1 + 1e-12;
    return A.ldlt().solve(-(J.transpose() * r));
}

std::vector<double> by_output(const VectorXd& r, std::size_t outputs) {
    std::vector<double> out;
    const Eigen::Index samples = r.size() / static_cast<Eigen::Index>(outputs);
    for (std::size_t o = 0; o < outputs; ++o)
        out.push_back(std::sqrt(r.segment(static_cast<Eigen::Index>(o) * samples, samples).squaredNorm() /
                                static_cast<double>(samples)));
    return out;
}

}  // namespace

std::vector<double> shown(const Machine& machine, const Run& run, std::size_t signal) {
    std::vector<double> out;
    for (const State& x : run.states) out.push_back(x[static_cast<std::size_t>(machine.system->signals[signal].state)]);
    for (const Effect& e : machine.effects) {
        if (e.signal != static_cast<int>(signal)) continue;
        for (double& v : out) v = e.shows(v, e.values.data());
    }
    return out;
}

std::vector<std::vector<double>> scored(const Machine& machine, const Run& run) {
    std::vector<std::vector<double>> out;
    for (std::size_t s = 0; s < machine.system->signals.size(); ++s) {
        if (machine.system->signals[s].state >= 0 && machine.system->signals[s].scored)
            out.push_back(shown(machine, run, s));
    }
    return out;
}

double Fitted::worst() const { return *std::max_element(rms.begin(), rms.end()); }

Fitted refit(Machine model, const Truth& truth, int iterations) {
    const std::vector<Free> free = free_values(model);
    VectorXd r = residual(model, truth);
    if (r.size() == 0) return {model, std::vector<double>(truth.outputs.size(), HUGE_VAL), false};
    for (int i = 0; i < iterations && !free.empty(); ++i) {
        const VectorXd step = least_squares(sensitivities(model, truth, free, r), r);
        double share = 1;
        bool better = false;
        for (int half = 0; half < 5 && !better; ++half, share /= 2) {
            Machine moved = model;
            for (std::size_t f = 0; f < free.size(); ++f) {
                double& value = free[f].in(moved);
                // A quantity keeps its sign: no fit may turn a resistance negative.
                value *= free[f].quantity >= 0 ? std::clamp(1 + share * step[static_cast<Eigen::Index>(f)], 0.05, 20.0)
                                               : 1 + share * step[static_cast<Eigen::Index>(f)];
            }
            const VectorXd there = residual(moved, truth);
            better = there.size() == r.size() && there.squaredNorm() < r.squaredNorm();
            if (better) {
                model = moved;
                r = there;
            }
        }
        if (!better) break;
    }
    return {model, by_output(r, truth.outputs.size()), true};
}

std::vector<double> left_with(const Fitted& fitted, const Truth& truth,
                              const std::vector<std::function<void(Machine&)>>& nudges) {
    const VectorXd r = residual(fitted.model, truth);
    const std::vector<Free> free = free_values(fitted.model);
    MatrixXd J = sensitivities(fitted.model, truth, free, r);
    J.conservativeResize(Eigen::NoChange, J.cols() + 1);
    std::vector<double> left;
    for (const auto& nudge : nudges) {
        Machine with = fitted.model;
        nudge(with);
        const VectorXd there = residual(with, truth);
        left.push_back(HUGE_VAL);
        if (there.size() != r.size() || !((there - r).squaredNorm() > 0)) continue;
        J.col(J.cols() - 1) = (there - r) * std::sqrt(static_cast<double>(r.size())) / (there - r).norm();
        const std::vector<double> rms = by_output(r + J * least_squares(J, r), truth.outputs.size());
        left.back() = *std::max_element(rms.begin(), rms.end());
    }
    return left;
}

}  // namespace algest::gap
