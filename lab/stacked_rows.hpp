// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of many instants, one below the other: what they determine, and how well their own residuals say it.
#pragma once
#include <Eigen/Dense>

namespace algest::lab {

/// P theta = Q; `rows` of them an instant.
struct StackedRows {
    Eigen::MatrixXd p;
    Eigen::VectorXd q;
    Eigen::Index rows;
    Eigen::Index instants() const { return p.rows() / rows; }
};

/// P with columns of norm 1, taken apart.
struct Decomposition {
    Eigen::VectorXd norm;       ///< of the columns; 1 for one of zeros
    Eigen::VectorXd singular;   ///< values, largest first
    Eigen::MatrixXd right;      ///< singular vectors, one a column
    Eigen::Index rank;
    Eigen::VectorXd solution;   ///< of the unknowns, the shortest in scaled ones
};

/// By QR and the singular values of its triangle. Directions below 1/condition_limit of the largest singular value do not count. Needs as many rows
/// as unknowns, finite. Cost: rows x unknowns^2.
Decomposition decompose(const StackedRows& of, double condition_limit);

/// Andrews (1991): for residuals that go like e_k = rho e_(k-1) + noise, how many instants Bartlett weights have to reach; at most a quarter of all.
/// Cost: rows.
double correlated_instants(const Eigen::VectorXd& residuals, const StackedRows& of);

/// Covariance of the unknowns in the directions that are determined, 0 in the others: of Newey and West, with Bartlett weights over `memory` instants.
/// Cost: memory x instants x unknowns^2.
Eigen::MatrixXd covariance(const StackedRows& of, const Decomposition& d, double memory);

}  // namespace algest::lab
