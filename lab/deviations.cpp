// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/deviations.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace algest::lab {

Eigen::VectorXd deviations_of(const Eigen::MatrixXd& normal, double digits) {
    constexpr double part = 1e-2;   // of a unit vector, by which a parameter lies in a direction
    const double infinity = std::numeric_limits<double>::infinity();
    const Eigen::VectorXd size = normal.diagonal().cwiseSqrt();
    const Eigen::VectorXd inverse = size.unaryExpr([](double s) { return s > 0 ? 1 / s : 0.0; });
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * normal * inverse.asDiagonal());
    Eigen::VectorXd out(normal.rows());
    for (Eigen::Index i = 0; i < normal.rows(); ++i) {
        double variance = 0;
        for (Eigen::Index d = 0; d < normal.rows(); ++d) {
            const double share = std::pow(solver.eigenvectors()(i, d), 2);
            if (solver.eigenvalues()[d] > digits * digits) variance += share / solver.eigenvalues()[d];
            else if (share > part * part) variance = infinity;
        }
        out[i] = size[i] > 0 ? std::sqrt(variance) * inverse[i] : infinity;
    }
    return out;
}

}  // namespace algest::lab
