// SPDX-License-Identifier: GPL-3.0-or-later
// Noise into rows, the covariance of residuals, and rows whitened with it: against changing every sample and against Eigen.
#include "algest/whitening.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "algest/estimator.hpp"

using namespace algest;

namespace {

constexpr int samples = 9, rows = 4, unknowns = 2, signals = 4;   // signals: x0, x1, x2, and the ring of a partial derivative

/// theta_0 K[x0] + theta_1 K[x1] = K[x2], four rows, another table for each; tables without a meaning.
struct Data {
    std::vector<double> tables, rings;
    std::vector<Functional> functionals;
    std::vector<Term<double>> terms;
    std::vector<NoiseChannel<double>> channels;
    RowSet<double> set;
    Noise<double> noise;
    WindowPosition at{samples + 3, 5};

    Data() {
        std::mt19937_64 random(8);
        std::normal_distribution<double> any;
        for (int t = 0; t < 3 * rows; ++t) {
            for (int k = 0; k < samples; ++k) tables.push_back(any(random));
        }
        for (int r = 0; r < rows; ++r) {
            for (int s = 0; s < 3; ++s) {
                functionals.push_back({static_cast<std::uint16_t>(3 * r + s), static_cast<std::uint16_t>(s), static_cast<std::uint16_t>(3 * r + s), 1});
                terms.push_back({static_cast<std::uint16_t>(r), static_cast<std::uint16_t>(s), 1.0 + 0.1 * r});
            }
        }
        rings.assign(static_cast<std::size_t>(ring_scalars(signals, at.length)), 0.0);
        for (int k = 0; k < at.length; ++k) {
            const std::array<double, signals> sample{any(random), any(random), any(random), any(random)};
            write_sample(rings.data(), signals, at.length, k, sample.data());
        }
        // Raw signal 0 enters x0 at once and x1 one sample late, times what ring 3 holds; raw signal 1 is x2.
        channels = {{0, 0, no_partial, 0, 0.3}, {0, 1, 3, 1, 0.5}, {1, 2, no_partial, 0, 0.2}};
        set = {samples, signals, rows, unknowns, {tables.data(), static_cast<int>(tables.size())}, {functionals.data(), 3 * rows}, {terms.data(), 3 * rows}};
        noise = {2, {channels.data(), 3}};
    }
    Eigen::Matrix<double, rows, unknowns + 1, Eigen::RowMajor> evaluated(const std::vector<double>& from) const {
        Eigen::Matrix<double, rows, unknowns + 1, Eigen::RowMajor> out;
        std::array<double, row_entries(rows, unknowns)> scratch{};
        evaluate_rows(set, from.data(), at, out.data(), scratch.data());
        return out;
    }
    /// The rings with raw sample k of a raw signal one standard deviation up.
    std::vector<double> moved(int input, int k) const {
        std::vector<double> out = rings;
        double* const ring = out.data() + at.start;
        const int twice = 2 * at.length;
        if (input == 0 && k >= 0) ring[k] += 0.3;
        if (input == 0 && k + 1 < samples) ring[twice + k + 1] += 0.5 * ring[3 * twice + k + 1];
        if (input == 1 && k >= 0) ring[2 * twice + k] += 0.2;
        return out;
    }
};

}  // namespace

TEST_CASE("noise in rows is what a sample that is one deviation up does, one sample late and through a partial derivative too") {
    const Data data;
    const auto here = data.evaluated(data.rings);
    for (int input = 0; input < 2; ++input) {
        for (int k = -1; k < samples; ++k) {
            Eigen::Matrix<double, rows, unknowns + 1, Eigen::RowMajor> found;
            noise_in_rows(data.set, data.noise, data.rings.data(), data.at, input, k, found.data());
            INFO("input " << input << ", sample " << k);
            CHECK((found - (data.evaluated(data.moved(input, k)) - here)).norm() < 1e-13);   // linear: rounding alone
        }
    }
}

TEST_CASE("whitened rows have residuals of covariance 1, and their least squares are the generalized ones") {
    const Data data;
    const Eigen::Vector2d theta(0.7, -1.9);
    const Eigen::Vector3d x(0.7, -1.9, -1.0);
    const auto here = data.evaluated(data.rings);
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    for (int input = 0; input < 2; ++input) {
        for (int k = -1; k < samples; ++k) {
            const Eigen::Vector4d change = (data.evaluated(data.moved(input, k)) - here) * x;
            covariance += change * change.transpose();
        }
    }
    std::vector<double> scratch(static_cast<std::size_t>(residual_factor_scratch(rows, unknowns)));
    Eigen::Matrix<double, rows, rows, Eigen::RowMajor> factor;
    REQUIRE(residual_factor(data.set, data.noise, data.rings.data(), data.at, theta.data(), scratch.data(), factor.data()));
    const Eigen::Matrix4d lower = Eigen::Matrix4d(factor).triangularView<Eigen::Lower>();
    CHECK((lower * lower.transpose() - covariance).norm() < 1e-12 * covariance.norm());

    auto white = here;
    whiten(factor.data(), white.data(), rows, unknowns + 1);
    std::vector<double> work(static_cast<std::size_t>(solve_rows_scratch(unknowns)));
    Eigen::Vector2d found;
    REQUIRE(solve_rows(white.data(), rows, unknowns, work.data(), found.data()).regular);
    const Eigen::Matrix<double, rows, unknowns> P = here.leftCols<unknowns>();
    const Eigen::Matrix4d weight = covariance.inverse();
    const Eigen::Vector2d wanted = (P.transpose() * weight * P).inverse() * P.transpose() * weight * here.col(unknowns);
    CHECK((found - wanted).norm() < 1e-10 * wanted.norm());   // normal equations of a condition below 1e4
}

TEST_CASE("rows without noise of their own cannot be whitened") {
    Data data;
    data.noise.inputs = 1;
    data.terms[0].factor = data.terms[1].factor = 0.0;   // row 0 sees x2 alone
    std::vector<double> scratch(static_cast<std::size_t>(residual_factor_scratch(rows, unknowns)));
    std::vector<double> factor(rows * rows);
    const std::array<double, 2> theta{1.0, 1.0};
    CHECK_FALSE(residual_factor(data.set, data.noise, data.rings.data(), data.at, theta.data(), scratch.data(), factor.data()));
}
