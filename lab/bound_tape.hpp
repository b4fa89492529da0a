// SPDX-License-Identifier: GPL-3.0-or-later
// A tape for a run in which most inputs stand still: what depends on those alone is evaluated once, not at every step.
#pragma once
#include <vector>

#include "generator/tape.hpp"

namespace algest::lab {

class BoundTape {
public:
    /// inputs: stays where it is for as long as this lives. fixed: by input, whether its value stays, too. The tape reads no past samples: else
    /// throws std::logic_error. Cost: one evaluation.
    BoundTape(const plan::Tape& tape, const std::vector<double>& inputs, const std::vector<bool>& fixed);
    BoundTape(BoundTape&&) = default;   // a copy would read the values of the other
    BoundTape(const BoundTape&) = delete;

    /// As plan::evaluate, to the last bit. results: one per result of the tape. Cost: the operations that depend on what moves.
    void evaluate(double* results);

private:
    /// Reads and writes values_, and reads the inputs.
    struct Step {
        plan::Op op;
        const double* a;
        const double* b;
        double* value;
    };
    std::vector<double> values_;   ///< one per operation of the tape
    std::vector<Step> steps_;      ///< what depends on inputs that are not fixed
    std::vector<const double*> results_;
};

}  // namespace algest::lab
