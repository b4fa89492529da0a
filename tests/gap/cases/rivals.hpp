// SPDX-License-Identifier: GPL-3.0-or-later
// What else explains a recording as well as the thing that is hidden.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "refit.hpp"

namespace algest::gap {

struct Rivals {
    std::vector<std::string> names;  ///< things of a usual library, without the hidden one
    bool same = false;               ///< for one of them this recording cannot tell
    std::vector<std::pair<std::string, std::string>> equal_terms;  ///< name and equation of those that are a term
};

/// `machine` is the true one, `model` the one without what is hidden: `hidden`, or a wrong quantity where that is nullptr.
Rivals rivals(const Machine& machine, const Machine& model, const Effect* hidden, const Truth& truth, const State& scale, Random& random);

}  // namespace algest::gap
