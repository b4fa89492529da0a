// SPDX-License-Identifier: GPL-3.0-or-later
// The three solvers against Eigen in long double: random, ill-conditioned and badly scaled systems are solved as well as their
// condition allows, and what has no full rank or is not finite is singular.
#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "algest/solve_gram.hpp"
#include "algest/solve_rows.hpp"
#include "algest/triangle_update.hpp"

namespace {

using Real = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using RealVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

template <class S>
constexpr S untouched = S(-12345);

/// rows x (unknowns + 1), [P|Q].
template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <class S>
struct Answer {
    algest::Solved<S> solved;
    Eigen::Matrix<S, Eigen::Dynamic, 1> x;
    S limit = sizeof(S) == sizeof(double) ? S(1e5) : S(8.4e3);  ///< as plans declare it; in float 1e-3 / epsilon
    /// As estimate() judges it.
    bool good() const { return solved.regular && solved.condition <= limit; }
};

template <class S>
Answer<S> by_rows(Matrix<S> pq) {
    const int rows = static_cast<int>(pq.rows()), n = static_cast<int>(pq.cols()) - 1;
    std::vector<S> scratch(static_cast<std::size_t>(algest::solve_rows_scratch(n)));
    Answer<S> out{{}, Eigen::Matrix<S, Eigen::Dynamic, 1>::Constant(n, untouched<S>)};
    out.solved = algest::solve_rows(pq.data(), rows, n, scratch.data(), out.x.data());
    return out;
}

/// The packed sums are formed in long double and rounded once: what is tested is the solver.
template <class S>
Answer<S> by_gram(const Matrix<S>& pq) {
    const int n = static_cast<int>(pq.cols()) - 1;
    const Real wide = pq.template cast<long double>();
    const Real sums = wide.transpose() * wide;
    std::vector<S> packed;
    for (int i = 0; i <= n; ++i) {
        for (int j = i; j <= n; ++j) packed.push_back(static_cast<S>(sums(i, j)));
    }
    std::vector<S> scratch(static_cast<std::size_t>(algest::solve_gram_scratch(n)));
    Answer<S> out{{}, Eigen::Matrix<S, Eigen::Dynamic, 1>::Constant(n, untouched<S>)};
    if (sizeof(S) == sizeof(float)) out.limit = S(92);  // the root of that of the others, since S(t) squares
    out.solved = algest::solve_gram(packed.data(), n, scratch.data(), out.x.data());
    return out;
}

/// The rows come in portions of `portion`, as the instants of an estimator do.
template <class S>
Answer<S> by_triangle(const Matrix<S>& pq, int portion = 1, S keep = S(1)) {
    const int n = static_cast<int>(pq.cols()) - 1;
    std::vector<S> triangle(static_cast<std::size_t>(algest::triangle_scalars(n)), S(0));
    for (int r = 0; r + portion <= pq.rows(); r += portion) {
        Matrix<S> rows = pq.middleRows(r, portion);
        algest::add_rows(triangle.data(), rows.data(), portion, n, keep);
    }
    std::vector<S> scratch(static_cast<std::size_t>(algest::solve_triangle_scratch(n)));
    Answer<S> out{{}, Eigen::Matrix<S, Eigen::Dynamic, 1>::Constant(n, untouched<S>)};
    out.solved = algest::solve_triangle(triangle.data(), n, scratch.data(), out.x.data());
    return out;
}

template <class S>
RealVector reference(const Matrix<S>& pq) {
    const Real wide = pq.template cast<long double>();
    const auto n = wide.cols() - 1;
    return wide.leftCols(n).colPivHouseholderQr().solve(wide.col(n));
}

/// P as the solvers scale it: rows to norm 1 where it is square, then columns to norm 1.
template <class S>
Real scaled(const Matrix<S>& pq, bool rows_too) {
    Real p = pq.template cast<long double>().leftCols(pq.cols() - 1);
    if (rows_too) p.rowwise().normalize();
    p.colwise().normalize();
    return p;
}

long double condition(const Real& p) {
    const RealVector s = Eigen::JacobiSVD<Real>(p).singularValues();
    return s(0) / s(s.size() - 1);
}

/// Largest error of an unknown, in units of what the scaled solution is long.
template <class S>
double error(const Answer<S>& answer, const Matrix<S>& pq) {
    const RealVector wanted = reference(pq);
    const RealVector norms = pq.template cast<long double>().leftCols(pq.cols() - 1).colwise().norm().transpose();
    const RealVector difference = (answer.x.template cast<long double>() - wanted).cwiseProduct(norms);
    return static_cast<double>(difference.norm() / wanted.cwiseProduct(norms).norm());
}

/// P with the given condition number, columns in different units, a solution of size 1 and a small residual where rows > n.
template <class S>
Matrix<S> system(int rows, int n, double wanted_condition, double residual, std::mt19937_64& random) {
    std::normal_distribution<double> normal(0.0, 1.0);
    const auto orthogonal = [&](int m, int k) {
        Eigen::MatrixXd a(m, k);
        for (int i = 0; i < m; ++i) {
            for (int j = 0; j < k; ++j) a(i, j) = normal(random);
        }
        return Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ() * Eigen::MatrixXd::Identity(m, k));
    };
    Eigen::VectorXd singular(n);
    for (int i = 0; i < n; ++i) singular(i) = std::pow(wanted_condition, n == 1 ? 0.0 : -static_cast<double>(i) / (n - 1));
    const Eigen::MatrixXd p = orthogonal(rows, n) * singular.asDiagonal() * orthogonal(n, n).transpose();
    Eigen::VectorXd theta(n), q(rows);
    for (int i = 0; i < n; ++i) theta(i) = normal(random);
    for (int i = 0; i < rows; ++i) q(i) = residual * normal(random);
    Matrix<S> out(rows, n + 1);
    out.leftCols(n) = p.template cast<S>();
    out.col(n) = (p * theta + q).template cast<S>();
    for (int j = 0; j < n; ++j) out.col(j) *= static_cast<S>(std::pow(2.0, 7 * (j % 5) - 14));  // units
    return out;
}

/// Roundings of a solve, each of epsilon times the condition. The solvers' constants are about n; ten is for the spread.
template <class S>
double tolerance(int n, double amplification) {
    return 10.0 * n * static_cast<double>(std::numeric_limits<S>::epsilon()) * amplification;
}

template <class S>
void random_systems(double hardest) {
    std::mt19937_64 random(11);
    for (int n = 1; n <= 6; ++n) {
        for (const int rows : {n, n + 1, 4 * n}) {
            for (double c = 1.0; c <= hardest; c *= 10.0) {
                for (int repeat = 0; repeat < 5; ++repeat) {
                    const Matrix<S> pq = system<S>(rows, n, c, rows > n ? 1e-3 / c : 0.0, random);
                    INFO("unknowns " << n << ", rows " << rows << ", condition " << c);

                    const Answer<S> square = by_rows<S>(pq);
                    const long double rows_condition = condition(scaled(pq, rows == n));
                    REQUIRE(square.solved.regular);
                    // of the scaled matrix, by Frobenius norms: not below the spectral one, at most n times above; the rest is
                    // rounding of the small singular value
                    const double slack = 1.0 + tolerance<S>(n, static_cast<double>(rows_condition));
                    CHECK(square.solved.condition * slack >= rows_condition * (1.0 - 1e-6));
                    CHECK(square.solved.condition <= n * rows_condition * slack * (1.0 + 1e-6));
                    CHECK(error(square, pq) <=
                          tolerance<S>(n, static_cast<double>(std::max(rows_condition, condition(scaled(pq, false))))));

                    const double column_condition = static_cast<double>(condition(scaled(pq, false)));
                    for (const int portion : {1, rows}) {
                        const Answer<S> least = by_triangle<S>(pq, portion);
                        REQUIRE(least.solved.regular);
                        CHECK(error(least, pq) <= tolerance<S>(rows, column_condition));
                        CHECK(least.solved.condition >=
                              column_condition * (1.0 - 1e-6) / (1.0 + tolerance<S>(rows, column_condition)));
                        CHECK(least.solved.condition <=
                              n * column_condition * (1.0 + 1e-6) * (1.0 + tolerance<S>(rows, column_condition)));
                    }

                    const double squared = column_condition * column_condition;
                    if (tolerance<S>(n, squared) > 0.1) continue;  // beyond what S(t) can carry in this scalar
                    const Answer<S> robust = by_gram<S>(pq);
                    REQUIRE(robust.solved.regular);
                    CHECK(error(robust, pq) <= tolerance<S>(n, squared));
                    const double gram_slack = 1.0 + tolerance<S>(n, squared);  // that of the rows, which S(t) squares
                    CHECK(robust.solved.condition * gram_slack >= column_condition * (1.0 - 1e-6));
                    CHECK(robust.solved.condition <= n * column_condition * gram_slack * (1.0 + 1e-6));
                }
            }
        }
    }
}

/// Every solver on the same rows.
template <class S>
std::vector<Answer<S>> all_answers(const Matrix<S>& pq) {
    return {by_rows<S>(pq), by_gram<S>(pq), by_triangle<S>(pq)};
}

template <class S>
void singular(const Answer<S>& a) {
    CHECK_FALSE(a.good());
    if (!a.solved.regular) {
        CHECK(std::isinf(a.solved.condition));
        CHECK((a.x.array() == untouched<S>).all());
    }
}

template <class S>
void singular(const Matrix<S>& pq) {
    for (const Answer<S>& a : all_answers(pq)) singular(a);
}

template <class S>
void without_full_rank() {
    std::mt19937_64 random(12);
    std::normal_distribution<double> normal(0.0, 1.0);
    for (int n = 2; n <= 6; ++n) {
        for (const int rows : {n, 3 * n}) {
            for (int repeat = 0; repeat < 20; ++repeat) {
                const Matrix<S> sound = system<S>(rows, n, 2.0, 0.1, random);
                for (const Answer<S>& a : all_answers(sound)) REQUIRE(a.good());
                for (int bad = 0; bad < n; ++bad) {
                    INFO("unknowns " << n << ", rows " << rows << ", column " << bad);
                    Matrix<S> pq = sound;
                    pq.col(bad).setZero();
                    singular(pq);
                    pq = sound;
                    pq.col(bad) = S(3) * pq.col((bad + 1) % n);  // proportional columns
                    singular(pq);
                    pq = sound;
                    pq.col(bad).setZero();
                    for (int j = 0; j < n; ++j) {
                        if (j != bad)
                            pq.col(bad) += static_cast<S>(normal(random)) * pq.col(j);  // dependent but for rounding
                    }
                    singular(pq);
                }
                // fewer rows than unknowns
                if (rows == n) {
                    Matrix<S> pq = sound;
                    pq.row(n - 1).setZero();
                    singular(pq);
                    pq = sound;
                    pq.row(0) = S(-2) * pq.row(n - 1);
                    singular(pq);
                }
            }
        }
    }
}

/// answer(pq) for rows with one number in them that is not finite, at each place.
template <class S, class Solver>
void not_finite(Solver answer) {
    std::mt19937_64 random(13);
    const S infinity = std::numeric_limits<S>::infinity();
    for (const S value : {std::numeric_limits<S>::quiet_NaN(), infinity, -infinity}) {
        for (int n = 1; n <= 4; ++n) {
            for (const int rows : {n, 2 * n}) {
                const Matrix<S> sound = system<S>(rows, n, 2.0, 0.1, random);
                REQUIRE(answer(sound).good());
                for (int r = 0; r < rows; ++r) {
                    for (int c = 0; c <= n; ++c) {
                        Matrix<S> pq = sound;
                        pq(r, c) = value;
                        INFO("value " << value << " at " << r << ", " << c << " of " << rows << " x " << n + 1);
                        singular(answer(pq));
                    }
                }
            }
        }
    }
}

/// Magnitudes whose squares overflow or vanish: an answer is then right or refused, never something that is not a number.
template <class S>
void extreme() {
    std::mt19937_64 random(14);
    const int largest = std::numeric_limits<S>::max_exponent10 - 1;
    for (int exponent = -largest - 6; exponent <= largest; ++exponent) {
        for (int n = 1; n <= 3; ++n) {
            Matrix<S> pq = system<S>(2 * n, n, 2.0, 0.0, random);
            pq *= static_cast<S>(std::pow(10.0L, exponent));
            for (const Answer<S>& a : all_answers(pq)) {
                INFO("10^" << exponent << ", unknowns " << n);
                const bool squares_fit = std::abs(exponent) <= largest / 2 - 2;   // entries are 10^exponent times at most ten
                if (squares_fit) REQUIRE(a.good());
                if (!a.good()) continue;
                CHECK(a.x.allFinite());
                // entries near the smallest numbers have few digits: those of the reference are the same
                if (exponent > -largest / 2 + 10) CHECK(error(a, pq) < 1e4 * std::numeric_limits<S>::epsilon());
            }
        }
    }
}

}  // namespace

TEST_CASE("solvers: as good as the condition allows, in double") { random_systems<double>(1e8); }
TEST_CASE("solvers: as good as the condition allows, in float") { random_systems<float>(1e3); }

TEST_CASE("solvers: without full rank singular") {
    without_full_rank<double>();
    without_full_rank<float>();
}

TEST_CASE("solve_rows: NaN and infinity are singular") {
    not_finite<double>(by_rows<double>);
    not_finite<float>(by_rows<float>);
}

TEST_CASE("solve_gram: NaN and infinity are singular") {
    not_finite<double>(by_gram<double>);
    not_finite<float>(by_gram<float>);
}

TEST_CASE("solvers: numbers near the limits of the scalar") {
    extreme<double>();
    extreme<float>();
}

TEST_CASE("solvers: units change neither condition nor digits") {
    std::mt19937_64 random(15);
    for (int repeat = 0; repeat < 50; ++repeat) {
        const Matrix<double> pq = system<double>(6, 3, 100.0, 0.01, random);
        Matrix<double> other = pq;
        for (int c = 0; c < 3; ++c) other.col(c) *= std::pow(2.0, 13 * (c - 1) * 4);  // powers of two: no rounding
        const auto a = all_answers(pq), b = all_answers(other);
        for (std::size_t k = 0; k < a.size(); ++k) {
            CHECK(a[k].solved.condition == Approx(b[k].solved.condition).epsilon(1e-12));
            for (int c = 0; c < 3; ++c) {
                CHECK(b[k].x(c) * std::pow(2.0, 13 * (c - 1) * 4) == Approx(a[k].x(c)).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("least squares with forgetting: old rows weigh less, as if they had been multiplied") {
    std::mt19937_64 random(16);
    constexpr int instants = 40, portion = 2, n = 3;
    for (const double keep : {0.5, 0.9, 0.999}) {
        const Matrix<double> pq = system<double>(portion * instants, n, 10.0, 0.5, random);
        Matrix<double> weighted = pq;
        for (int k = 0; k < instants; ++k) weighted.middleRows(portion * k, portion) *= std::pow(keep, instants - 1 - k);
        const Answer<double> found = by_triangle<double>(pq, portion, keep);
        REQUIRE(found.good());
        CHECK(error(found, weighted) < 1e-12);  // condition 10, 80 rows, 40 multiplications
        CHECK(error(found, pq) > 1e-6);         // without the weights it is another answer
    }
}

TEST_CASE("least squares keeps its digits over a million rows") {
    std::mt19937_64 random(17);
    std::normal_distribution<double> normal(0.0, 1.0);
    constexpr int n = 3;
    std::vector<double> triangle(static_cast<std::size_t>(algest::triangle_scalars(n)), 0.0);
    Real sums = Real::Zero(n + 1, n + 1);
    for (int k = 0; k < 1'000'000; ++k) {
        double row[n + 1];
        double known = 0.0;
        for (int i = 0; i < n; ++i) {
            row[i] = normal(random);
            known += (i + 1) * row[i];
        }
        row[n] = known + 0.1 * normal(random);
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) sums(i, j) += static_cast<long double>(row[i]) * row[j];
        }
        algest::add_rows(triangle.data(), row, 1, n, 1.0);
    }
    double scratch[algest::solve_triangle_scratch(n)];
    double x[n];
    const auto solved = algest::solve_triangle(triangle.data(), n, scratch, x);
    REQUIRE(solved.regular);
    const RealVector wanted = sums.topLeftCorner(n, n).ldlt().solve(sums.col(n).head(n));
    for (int i = 0; i < n; ++i) {
        // a million rotations, each rounded: sqrt(1e6) epsilon = 2e-13, times what is not random in them
        CHECK(std::abs(x[i] / static_cast<double>(wanted(i)) - 1.0) < 1e-11);
    }
    // the last entry of the triangle is the root of the sum of squared residuals
    const long double residual = sums(n, n) - wanted.dot(sums.col(n).head(n));
    CHECK(std::abs(triangle.back()) == Approx(static_cast<double>(std::sqrt(residual))).epsilon(1e-9));
}
