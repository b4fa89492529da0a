// SPDX-License-Identifier: GPL-3.0-or-later
// A model with [filter] as data, and the files that it becomes: the parabola filter of 001 as a block of its own.
#pragma once
#include <string>
#include <vector>

#include "generator/generate.hpp"
#include "generator/model.hpp"

namespace algest::generator {

struct FilteredInput {
    plan::Input input;
    std::string derivative_unit;            ///< empty: the signal's is not declared
    std::optional<exact::Rational> noise;   ///< standard deviation, in the unit
};

struct FilterBlock {
    std::string name;
    std::string class_name;
    std::string summary;
    std::string source;
    plan::Scalar scalar;
    exact::Rational period;   ///< s
    std::vector<FilteredInput> inputs;
};

/// The model must have a filter.
FilterBlock filter_block(const model::Model& model, plan::Scalar scalar);

/// NAME/NAME.hpp and NAME/NAME.md.
std::vector<EmittedFile> emit_filter(const FilterBlock& block);

/// Transfer functions, poles, delay, frequency response, gain of noise.
std::string filter_derivation(const FilterBlock& block);

}  // namespace algest::generator
