// SPDX-License-Identifier: GPL-3.0-or-later
// push and estimate of the bare runtime: when they answer, what they answer, and what they do with samples that are refused, say
// nothing, or overflow.
#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "tests/runtime/small_estimator.hpp"

using namespace algest;
using test::small_rows;
using test::small_sample;
using test::small_signals;
using test::small_unknowns;

namespace {

constexpr int samples = 11;
constexpr int instants = 6;
using Sample = std::array<double, small_signals>;
using Rows = Eigen::Matrix<long double, small_rows, small_unknowns + 1>;

struct Found {
    Status status;
    double condition;
    std::array<double, small_unknowns> lumped;
};

constexpr double untouched = -12345.0;

Found estimate(test::SmallEstimator<double>& estimator) {
    std::array<double, small_unknowns> lumped{untouched, untouched};
    const Latest<double> latest = estimator.estimate(lumped);
    REQUIRE(latest.current);
    if (latest.status == Status::filling || latest.status == Status::rejected) {
        REQUIRE(lumped == std::array<double, small_unknowns>{untouched, untouched});
    }
    return {latest.status, latest.condition, lumped};
}

Found step(test::SmallEstimator<double>& estimator, const Sample& sample) {
    estimator.push(sample.data());
    return estimate(estimator);
}

/// The same estimator by its definition, in long double: rows of each full window, stacked as the solve asks for.
class Reference {
public:
    explicit Reference(const test::SmallData<double>& data, double factor = 1.0) : data_(data), factor_(factor) {}

    void push(const Sample& sample) {
        window_.push_back(sample);
        if (window_.size() > samples) window_.pop_front();
        if (window_.size() < samples) return;
        Rows rows;
        for (int r = 0; r < small_rows; ++r) {
            for (int s = 0; s < small_signals; ++s) {
                const int f = r * small_signals + s;
                long double sum = 0.0L;
                for (int k = 0; k < samples; ++k) {
                    sum += static_cast<long double>(data_.tables[static_cast<std::size_t>(f * samples + k)]) *
                           window_[static_cast<std::size_t>(k)][static_cast<std::size_t>(s)];
                }
                rows(r, s) = sum * factor_ * (1.0L + 0.25L * f);
            }
        }
        // What overflows in double is no row.
        if (rows.cwiseAbs().maxCoeff() > std::numeric_limits<double>::max()) return;
        instants_.push_back(rows);
        if (data_.blueprint.solve == Solve::robust && instants_.size() > instants) instants_.pop_front();
        if (data_.blueprint.solve == Solve::square) instants_ = {rows};
    }
    void refuse() {
        window_.clear();
        if (data_.blueprint.solve != Solve::least_squares) instants_.clear();
    }
    /// Nothing while a window or S(t) is not full.
    std::optional<std::array<double, small_unknowns>> solution() const {
        const bool full = window_.size() == samples && !instants_.empty() &&
                          (data_.blueprint.solve != Solve::robust || instants_.size() == instants);
        if (!full) return std::nullopt;
        using Stacked = Eigen::Matrix<long double, Eigen::Dynamic, small_unknowns + 1>;
        Stacked all(static_cast<Eigen::Index>(instants_.size()) * small_rows, small_unknowns + 1);
        Eigen::Index at = 0;
        for (const Rows& rows : instants_) {
            all.middleRows(at, small_rows) = rows;
            at += small_rows;
        }
        const auto x = all.leftCols(small_unknowns).colPivHouseholderQr().solve(all.col(small_unknowns)).eval();
        return std::array<double, small_unknowns>{static_cast<double>(x(0)), static_cast<double>(x(1))};
    }

private:
    const test::SmallData<double>& data_;
    long double factor_;
    std::deque<Sample> window_;
    std::deque<Rows> instants_;
};

void same(const Found& found, const Reference& reference) {
    const auto wanted = reference.solution();
    if (!wanted) {
        REQUIRE(found.status == Status::filling);
        REQUIRE(std::isinf(found.condition));
        return;
    }
    if (found.status == Status::singular && found.condition > 1e5) return;  // chance
    REQUIRE(found.status == Status::ok);
    const double size = std::abs((*wanted)[0]) + std::abs((*wanted)[1]);
    for (std::size_t i = 0; i < small_unknowns; ++i) {
        // a dozen roundings of each functional, which the condition enlarges; S(t) squares it
        REQUIRE(std::abs(found.lumped[i] - (*wanted)[i]) <= 1e-14 * size * found.condition * found.condition);
    }
}

constexpr Solve solves[] = {Solve::square, Solve::robust, Solve::least_squares};

}  // namespace

TEST_CASE("estimator: filling to the sample that fills it, then what the definition says") {
    for (const Solve solve : solves) {
        const test::SmallData<double> data(solve, samples, instants);
        test::SmallEstimator<double> estimator(data);
        Reference reference(data);
        const unsigned first = solve == Solve::robust ? samples + instants - 1 : samples;
        for (unsigned k = 1; k < 200; ++k) {
            INFO("solve " << static_cast<int>(solve) << ", sample " << k);
            const Found found = step(estimator, small_sample(k));
            reference.push(small_sample(k));
            REQUIRE((found.status == Status::filling) == (k < first));
            same(found, reference);
        }
        estimator.reset();
        REQUIRE(estimate(estimator).status == Status::filling);
        for (unsigned k = 1; k < first; ++k) REQUIRE(step(estimator, small_sample(k)).status == Status::filling);
        CHECK(step(estimator, small_sample(first)).status == Status::ok);
    }
}

TEST_CASE("estimator: a refused sample restarts the windows; least squares keeps its rows") {
    for (const Solve solve : solves) {
        const test::SmallData<double> data(solve, samples, instants);
        const int first = solve == Solve::robust ? samples + instants - 1 : samples;
        for (const int before : {0, 1, samples - 1, samples, samples + instants, 50}) {
            test::SmallEstimator<double> estimator(data);
            Reference reference(data);
            for (int k = 0; k < before; ++k) {
                estimator.push(small_sample(static_cast<unsigned>(k)).data());
                reference.push(small_sample(static_cast<unsigned>(k)));
            }
            for (int again = 0; again < 2; ++again) {
                estimator.push(nullptr);
                REQUIRE(estimate(estimator).status == Status::rejected);
                REQUIRE(std::isinf(estimate(estimator).condition));
            }
            reference.refuse();
            if (before % 2 == 0) {
                estimator.prime();  // as a model does whose signals are one sample late
                REQUIRE(estimate(estimator).status == Status::filling);
            }
            for (int k = 1; k <= first + 20; ++k) {
                INFO("solve " << static_cast<int>(solve) << ", " << before << " before, sample " << k);
                const Sample sample = small_sample(static_cast<unsigned>(1000 + k));
                const Found found = step(estimator, sample);
                reference.push(sample);
                REQUIRE((found.status == Status::filling) == (k < first));
                same(found, reference);
            }
        }
    }
}

TEST_CASE("estimator: samples that say nothing are singular") {
    for (const Solve solve : solves) {
        const test::SmallData<double> data(solve, samples, instants);
        test::SmallEstimator<double> estimator(data);
        Status status = Status::filling;
        for (int k = 0; k < 40; ++k) status = step(estimator, {0.0, 0.0, 0.0}).status;
        CHECK(status == Status::singular);
        estimator.reset();
        for (unsigned k = 0; k < 40; ++k) {
            const Sample s = small_sample(k);
            status = step(estimator, {s[0], 0.0, s[2]}).status;  // one unknown leaves no trace
        }
        CHECK(status == Status::singular);
    }
}

TEST_CASE("estimator: rows that overflow are left out, and the others answer") {
    constexpr double most = std::numeric_limits<double>::max();
    constexpr double factor = 1e10;  // of the rows: a wild sample makes them infinite, or infinity less infinity
    for (const Solve solve : solves) {
        const test::SmallData<double> data(solve, samples, instants, 1.0, factor);
        test::SmallEstimator<double> estimator(data);
        Reference reference(data, factor);
        int ok = 0;
        for (unsigned k = 0; k < 300; ++k) {
            INFO("solve " << static_cast<int>(solve) << ", sample " << k);
            const bool wild = k % 60 >= 50 && k % 60 < 53;
            const Sample sample = wild ? Sample{most, k % 2 == 0 ? most : -most, -most} : small_sample(k);
            estimator.push(sample.data());
            reference.push(sample);
            const Found found = estimate(estimator);
            if (found.status == Status::ok) {
                REQUIRE(std::isfinite(found.lumped[0]));
                REQUIRE(std::isfinite(found.lumped[1]));
            }
            if (k % 60 >= 50 || (k >= 60 && k % 60 < 53 + samples - 1 - 60)) continue;  // wild ones in the window
            same(found, reference);
            ok += found.status == Status::ok ? 1 : 0;
        }
        CHECK(ok > 100);
    }
}

TEST_CASE("estimator: above the condition limit it is singular, and says the condition") {
    for (const Solve solve : solves) {
        test::SmallData<double> data(solve, samples, instants);
        test::SmallEstimator<double> estimator(data);
        for (unsigned k = 0; k < 40; ++k) estimator.push(small_sample(k).data());
        const Found found = estimate(estimator);
        REQUIRE(found.status == Status::ok);
        data.blueprint.condition_limit = found.condition;
        CHECK(estimate(estimator).status == Status::ok);
        data.blueprint.condition_limit = std::nextafter(found.condition, 0.0);
        std::array<double, small_unknowns> lumped{};
        const Latest<double> above = estimator.estimate(lumped);
        CHECK(above.status == Status::singular);
        CHECK(above.condition == found.condition);
    }
}
