// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/stretch.hpp"

#include <algorithm>
#include <utility>

namespace algest::lab {

RowRange rows_of(const Recording& recording, const Stretch& stretch) {
    const std::vector<double>& t = recording.t;
    const auto begin = std::lower_bound(t.begin(), t.end(), stretch.from);
    const auto end = std::upper_bound(begin, t.end(), stretch.to);
    return {static_cast<std::size_t>(begin - t.begin()), static_cast<std::size_t>(end - t.begin())};
}

bool read_inputs(const plan::Plan& plan, const Recording& recording, std::vector<std::vector<double>>& inputs, Diagnostics& diagnostics) {
    for (const plan::Input& input : plan.inputs) {
        auto values = signal_values(recording, {input.name, input.column, input.unit}, diagnostics);
        if (values) inputs.push_back(std::move(*values));
    }
    return inputs.size() == plan.inputs.size();
}

}  // namespace algest::lab
