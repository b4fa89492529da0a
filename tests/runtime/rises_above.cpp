// SPDX-License-Identifier: GPL-3.0-or-later
// S(t) against a floor: positive definite differences and others, by Eigen's eigenvalues, whatever the units of the unknowns.
#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <limits>
#include <random>
#include <vector>

#include "algest/solve_gram.hpp"

using namespace algest;

namespace {

std::vector<double> packed(const Eigen::MatrixXd& m) {
    std::vector<double> out;
    for (Eigen::Index i = 0; i < m.rows(); ++i) for (Eigen::Index j = i; j < m.cols(); ++j) out.push_back(m(i, j));
    return out;
}

/// S, with a known side behind it that must not matter.
std::vector<double> gram(const Eigen::MatrixXd& s) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Constant(s.rows() + 1, s.cols() + 1, -7.0);
    out.topLeftCorner(s.rows(), s.cols()) = s;
    return packed(out);
}

bool above(const Eigen::MatrixXd& s, const Eigen::MatrixXd& floor) {
    const int n = static_cast<int>(s.rows());
    std::vector<double> scratch(static_cast<std::size_t>(rises_above_scratch(n)));
    return rises_above(gram(s).data(), packed(floor).data(), n, scratch.data());
}

}  // namespace

TEST_CASE("a sum rises above a floor where the smallest eigenvalue of the difference is positive") {
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    const auto matrix = [&](int rows, int columns) { return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); })); };
    int yes = 0, no = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const int n = 1 + trial % 5;
        const Eigen::MatrixXd p = matrix(n + 2, n), e = matrix(1 + trial % 3, n);   // a floor of low rank: some signals have no noise
        const Eigen::VectorXd units = Eigen::VectorXd::NullaryExpr(n, [&] { return std::pow(10.0, 4.0 * normal(random)); });
        const Eigen::MatrixXd s = p.transpose() * p, floor = 0.2 * e.transpose() * e;
        const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s - floor).eigenvalues()(0);
        if (std::abs(smallest) < 1e-6) continue;   // either answer is right
        const bool wanted = smallest > 0.0;
        CHECK(above(units.asDiagonal() * s * units.asDiagonal(), units.asDiagonal() * floor * units.asDiagonal()) == wanted);
        (wanted ? yes : no) += 1;
    }
    CHECK(yes > 200);
    CHECK(no > 200);
}

TEST_CASE("a floor above which nothing can rise: an empty column, and what is not finite") {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, 2);
    CHECK(above(Eigen::MatrixXd::Identity(2, 2), none));
    CHECK_FALSE(above(none, none));
    CHECK_FALSE(above((Eigen::MatrixXd(2, 2) << 1, 0, 0, std::numeric_limits<double>::quiet_NaN()).finished(), none));
    CHECK_FALSE(above((Eigen::MatrixXd(2, 2) << 1, 0, 0, std::numeric_limits<double>::infinity()).finished(), none));
}
