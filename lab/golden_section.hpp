// SPDX-License-Identifier: GPL-3.0-or-later
// The least value of a function of one variable, by golden section.
#pragma once

namespace algest::lab {

/// Where f is least between low and high, to 1/300 of their distance; f has one valley there. Cost: 14 calls.
template <class F>
double least_by_golden_section(const F& f, double low, double high) {
    constexpr double golden = 0.6180339887498949;
    constexpr int steps = 12;   // 0.618^12
    double a = high - golden * (high - low);
    double b = low + golden * (high - low);
    double at_a = f(a);
    double at_b = f(b);
    for (int step = 0; step < steps; ++step) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - golden * (high - low);
            at_a = f(a);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + golden * (high - low);
            at_b = f(b);
        }
    }
    return at_a < at_b ? a : b;
}

}  // namespace algest::lab
