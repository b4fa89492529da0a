// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/parabola_derivative.hpp"

namespace algest::lab {

FilteredSignal parabola_derivative(const std::vector<double>& t, const std::vector<double>& z) {
    const std::size_t samples = z.size();
    FilteredSignal out{std::vector<double>(samples), std::vector<double>(samples)};
    out.value[0] = z[0];
    out.derivative[0] = (z[1] - z[0]) / (t[1] - t[0]);
    for (std::size_t k = 1; k + 1 < samples; ++k) {
        const double value = out.value[k - 1];
        const double slope = out.derivative[k - 1];
        const double here = t[k] - t[k - 1];
        const double next = t[k + 1] - t[k - 1];
        const double miss_here = (value + slope * here) - z[k];
        const double miss_next = (value + slope * next) - z[k + 1];
        const double here2 = here * here;
        const double next2 = next * next;
        const double bend = -(miss_here * here2 + miss_next * next2) / (here2 * here2 + next2 * next2);   // a of equation (5)
        out.value[k] = value + slope * here + bend * here2;
        out.derivative[k] = slope + 2.0 * bend * here;
    }
    const std::size_t last = samples - 1;
    out.value[last] = z[last];
    out.derivative[last] = (z[last] - out.value[last - 1]) / (t[last] - t[last - 1]);
    return out;
}

}  // namespace algest::lab
