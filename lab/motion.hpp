// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion at one instant: what moves the states, what sensors show, what holds a relay's argument where it is.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "lab/bound_tape.hpp"
#include "lab/ode_system.hpp"

namespace algest::lab {

using State = std::vector<double>;   ///< by state entry

class Motion {
public:
    /// system: outlives this.
    Motion(const OdeSystem& system, const std::vector<double>& parameters);
    Motion(const Motion&) = delete;   // tapes read the inputs of their own

    /// Input k of the tapes: signals, delayed signals, relays, widths of layers.
    double& input(int k) { return inputs_[static_cast<std::size_t>(k)]; }
    double& delayed(std::size_t d) { return input(system_.delay_input + static_cast<int>(d)); }
    double& relay(std::size_t r) { return input(system_.relay_input + static_cast<int>(r)); }

    void set_state(const State& x) {
        for (std::size_t i = 0; i < x.size(); ++i) inputs_[entry_input_[i]] = x[i];
    }

    /// Sensors at the present inputs. False where one shows no number; it is 0 then.
    bool show();
    /// The same with what laws set: they see what the sensors show; what a sensor shows of a law's signal is that of this instant.
    bool show_and_control();

    /// All results of the equations at the present inputs, for `argument`. Cost: what moves of their tape.
    void evaluate();
    /// Result k, as it was evaluated last: the argument of a relay or a layer.
    double argument(int k) const { return results_[static_cast<std::size_t>(k)]; }

    /// dx/dt with inputs and relays as they are set. Cost: one evaluation, and one per highest derivative where the masses move.
    void rate(State& out);

    /// The value between -1 and 1 of relay r that keeps its argument where it is at x; beyond them where none does. Sets the state, and the relay
    /// to -1. scale: typical sizes of the states.
    double holding_value(std::size_t r, const State& x, const std::vector<double>& scale);
    /// d(argument)/dt along the motion from x, with the relays as they are set. Sets the state.
    double argument_rate(std::size_t r, const State& x, const std::vector<double>& scale);

    /// Since the start: for Effort.
    std::size_t evaluations() const { return evaluations_; }

private:
    std::size_t input_of(const StateEntry& entry) const;
    BoundTape bound(const plan::Tape& tape) const;
    const Eigen::VectorXd& highest();

    const OdeSystem& system_;
    std::vector<double> inputs_;
    BoundTape equations_;
    std::vector<BoundTape> outputs_;
    std::vector<BoundTape> laws_;
    std::vector<double> results_;
    std::vector<std::size_t> entry_input_;
    Eigen::MatrixXd mass_;
    Eigen::MatrixXd inverse_;   ///< of the mass matrix
    bool inverted_ = false;
    Eigen::VectorXd residual_;
    Eigen::VectorXd highest_;
    std::size_t evaluations_ = 0;
};

}  // namespace algest::lab
