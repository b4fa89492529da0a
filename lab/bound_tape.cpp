// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/bound_tape.hpp"

#include <stdexcept>

namespace algest::lab {

using plan::Op;

BoundTape::BoundTape(const plan::Tape& tape, const std::vector<double>& inputs, const std::vector<bool>& fixed) : values_(tape.operations.size()) {
    std::vector<const double*> at;   // by operation, where its value stands
    std::vector<bool> stays;
    for (const plan::Operation& o : tape.operations) {
        if (o.op == Op::previous || o.op == Op::derivative) throw std::logic_error("a run reads no past samples");
        if (o.op == Op::input) {
            at.push_back(&inputs[static_cast<std::size_t>(o.a)]);
            stays.push_back(fixed[static_cast<std::size_t>(o.a)]);
            continue;
        }
        double* const value = &values_[at.size()];
        Step step = {o.op, nullptr, nullptr, value};
        bool still = true;
        const auto read = [&](int operand, const double*& from) {
            if (operand < 0) return;
            from = at[static_cast<std::size_t>(operand)];
            still = still && stays[static_cast<std::size_t>(operand)];
        };
        read(o.a, step.a);
        read(o.b, step.b);
        *value = o.op == Op::constant ? o.value : plan::operated(step.op, step.a, step.b);
        if (!still) steps_.push_back(step);
        at.push_back(value);
        stays.push_back(still);
    }
    for (const int r : tape.results) results_.push_back(at[static_cast<std::size_t>(r)]);
}

void BoundTape::evaluate(double* results) {
    for (const Step& step : steps_) *step.value = plan::operated(step.op, step.a, step.b);
    for (std::size_t r = 0; r < results_.size(); ++r) results[r] = *results_[r];
}

}  // namespace algest::lab
