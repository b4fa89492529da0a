// SPDX-License-Identifier: GPL-3.0-or-later
// Which window engine costs less: multiply-adds a sample, counted.
#pragma once
#include <string>

#include "generator/plan.hpp"

namespace algest::lab {

struct EngineChoice {
    std::string engine;    ///< "fir" or "moments"
    double multiply_adds;  ///< a sample with an estimate
};

/// Dot products of the window against accumulators of moments, four of them rebuilt beside the one that serves (design.md, section 5).
EngineChoice cheaper_engine(const plan::Plan& plan);

}  // namespace algest::lab
