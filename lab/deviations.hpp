// SPDX-License-Identifier: GPL-3.0-or-later
// How well a least squares knows each of its parameters.
#pragma once
#include <Eigen/Core>

namespace algest::lab {

/// Standard deviations, for residuals of variance 1, from the normal equations S^T S (n x n, in the parameters' units); infinite for what lies
/// in a direction that no row sees, or whose column is zero. digits: columns more alike than that, relatively, are not told apart. Cost n^3.
Eigen::VectorXd deviations_of(const Eigen::MatrixXd& normal, double digits);

}  // namespace algest::lab
