// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of motion that differentiate an input: what its jumps at the samples do to the states.
//
// A held input jumps by U at a sample: its derivative of order j is U times that of order j-1 of an impulse there. Of an input that runs
// straight between samples the slope jumps by U: order j-2. Where derivative i of a signal jumps by Y_i, its derivative k holds Y_i times that
// of order k-1-i of an impulse. In an equation these sum to zero, order by order: from the highest order q down, order q gives Y_(n-1-q)
// of the signal whose derivative n the equation gives. That needs factors that no signal moves.
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "generator/tape_builder.hpp"
#include "lab/free_run.hpp"

namespace algest::lab {

/// Fills `input_jumps` of a system whose tape inputs are numbered; motion: its equations of motion, one per moving signal, in that order.
/// Complains (bad input) and returns false where a jump has a factor that moves, or where it would throw a signal out to infinity.
bool find_input_jumps(const model::Model& model, const std::vector<const model::Equation*>& motion, const TapeInputs& inputs, OdeSystem& system,
                      Diagnostics& diagnostics);

/// The jumps of the states with the parameters of one run.
class StateJumps {
public:
    StateJumps(const OdeSystem& system, const std::vector<double>& parameters, const std::vector<bool>& held);

    /// Adds to the states what the inputs' jumps at a sample, not the run's first, do to them. Cost: one product a state and input that jumps.
    void at_sample(const Drive& drive, std::size_t sample, std::vector<double>& x) const;

private:
    struct OfInput {
        int signal;
        Eigen::VectorXd response;   ///< of the states to a jump by one
    };
    std::vector<OfInput> inputs_;
};

}  // namespace algest::lab
