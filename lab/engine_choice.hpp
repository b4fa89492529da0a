// SPDX-License-Identifier: GPL-3.0-or-later
// Which window engine costs a model less: multiply-adds a sample, counted.
#pragma once
#include <string>

#include "generator/model.hpp"

namespace algest::lab {

struct EngineChoice {
    std::string engine;    ///< "fir" or "moments"; empty: the model has no estimator
    long multiply_adds;    ///< a sample with an estimate
};

/// By generator/cost.hpp; of the engines that the model can have. Cost: two plans without weights.
EngineChoice cheaper_engine(const model::Model& model);

}  // namespace algest::lab
