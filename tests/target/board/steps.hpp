// SPDX-License-Identifier: MIT-0
// One estimator, sample after sample: what host and board run alike. HEADER and CLASS say which.
#pragma once
#include HEADER

using Estimator = algest::generated::CLASS;
using Scalar = Estimator::Scalar;

/// The estimate as scalars: status, condition, parameters.
constexpr unsigned answer_width = sizeof(Estimator::Estimate) / sizeof(Scalar);
struct Answer {
    Scalar values[answer_width];
};

inline Answer answer(const Estimator::Estimate& estimate) {
    Answer out;
    const Scalar* from = &estimate.condition;
    out.values[0] = static_cast<Scalar>(static_cast<int>(estimate.status));
    for (unsigned k = 1; k < answer_width; ++k) out.values[k] = from[k - 1];
    return out;
}
