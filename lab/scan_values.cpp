// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/scan_values.hpp"

namespace algest::lab {

std::vector<double> scan_values(const EffectScan& scan, double unit) {
    std::vector<double> out;
    if (scan.factor > 0) {
        for (double value = scan.from; value <= scan.to * (1 + 1e-9); value *= scan.factor) out.push_back(value * unit);
        return out;
    }
    const int steps = static_cast<int>((scan.to - scan.from) / scan.step + 1e-9);
    for (int k = 0; k <= steps; ++k) out.push_back((scan.from + k * scan.step) * unit);
    return out;
}

}  // namespace algest::lab
