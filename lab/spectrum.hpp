// SPDX-License-Identifier: GPL-3.0-or-later
// The strongest lines in the spectrum of a residual.
#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <vector>

namespace algest::lab {

/// rad/s: the width of a line in `samples` samples, half a wave over all of them.
double line_width(std::size_t samples, double period);

struct SpectralLine {
    double step;    ///< rad from one value of the residual to the next, 0 to pi
    double share;   ///< of the residual's power
};

/// The strongest lines, strongest first, at most `most`, each a local maximum at least two lines' width from a stronger one, placed to a
/// twentieth of a width. Slower than two whole waves is drift, not a line. Cost: half of size^2.
std::vector<SpectralLine> spectral_lines(const Eigen::VectorXd& residual, std::size_t most);

}  // namespace algest::lab
