// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as a person or a file would hold them: a few digits.
#pragma once
#include <cstdio>
#include <cstdlib>

namespace algest::gap {

inline double rounded(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return std::strtod(text, nullptr);
}

}  // namespace algest::gap
