// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/median.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace algest::lab {

std::optional<double> median(std::vector<double> values) {
    if (values.empty()) return std::nullopt;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return std::midpoint(*std::max_element(values.begin(), middle), *middle);
}

}  // namespace algest::lab
