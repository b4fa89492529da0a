// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/stacked_rows.hpp"

#include <algorithm>
#include <cmath>

namespace algest::lab {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Decomposition decompose(const StackedRows& of, double condition_limit) {
    Decomposition out;
    out.norm = of.p.colwise().norm();
    for (double& n : out.norm) n = n > 0.0 ? n : 1.0;
    const Eigen::HouseholderQR<MatrixXd> qr(of.p * out.norm.cwiseInverse().asDiagonal());
    const Eigen::Index n = of.p.cols();
    const MatrixXd upper = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
    const VectorXd right_side = (qr.householderQ().adjoint() * of.q).head(n);
    const Eigen::JacobiSVD<MatrixXd> svd(upper, Eigen::ComputeFullU | Eigen::ComputeFullV);
    out.singular = svd.singularValues();
    out.right = svd.matrixV();
    out.rank = (out.singular.array() * condition_limit > out.singular(0)).count();
    VectorXd coordinates = svd.matrixU().adjoint() * right_side;
    for (Eigen::Index i = 0; i < n; ++i) coordinates(i) = i < out.rank ? coordinates(i) / out.singular(i) : 0.0;
    out.solution = (out.right * coordinates).cwiseQuotient(out.norm);
    return out;
}

double correlated_instants(const VectorXd& residuals, const StackedRows& of) {
    double most = 0.0;
    for (Eigen::Index r = 0; r < of.rows; ++r) {
        double here = 0.0;
        double next = 0.0;
        for (Eigen::Index k = 0; k + 1 < of.instants(); ++k) {
            here += residuals(k * of.rows + r) * residuals(k * of.rows + r);
            next += residuals(k * of.rows + r) * residuals((k + 1) * of.rows + r);
        }
        const double rho = here > 0.0 ? std::clamp(next / here, -0.99, 0.99) : 0.0;
        const double curvature = 2.0 * rho / (1.0 - rho * rho);
        most = std::max(most, 1.1447 * std::cbrt(curvature * curvature * static_cast<double>(of.instants())));
    }
    return std::min(most, static_cast<double>(of.instants()) / 4.0);
}

MatrixXd covariance(const StackedRows& of, const Decomposition& d, double memory) {
    const VectorXd residuals = of.p * d.solution - of.q;
    MatrixXd scores(of.p.cols(), of.instants());   // P'e of each instant, columns of P at norm 1
    for (Eigen::Index k = 0; k < of.instants(); ++k) {
        scores.col(k) = d.norm.cwiseInverse().asDiagonal() * (of.p.middleRows(k * of.rows, of.rows).transpose() * residuals.segment(k * of.rows, of.rows));
    }
    MatrixXd sum = scores * scores.transpose();
    for (Eigen::Index lag = 1; static_cast<double>(lag) < memory; ++lag) {
        const MatrixXd cross = scores.rightCols(of.instants() - lag) * scores.leftCols(of.instants() - lag).transpose();
        sum += (1.0 - static_cast<double>(lag) / memory) * (cross + cross.transpose());
    }
    const MatrixXd kept = d.right.leftCols(d.rank);
    const MatrixXd inverse = kept * d.singular.head(d.rank).array().square().inverse().matrix().asDiagonal() * kept.transpose();
    const auto unscale = d.norm.cwiseInverse().asDiagonal();
    return unscale * inverse * sum * inverse * unscale;
}

}  // namespace algest::lab
