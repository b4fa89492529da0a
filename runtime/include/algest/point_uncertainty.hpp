// SPDX-License-Identifier: MIT-0
// What errors of the means of operating points do to the parameters that least squares or an elimination find from all of them: covariance by the delta
// method, and the bias that errors in the regressors cause.
//
// Rows P u(theta) = Q; with e = dP u - dQ, theta^ - theta = -(J'J)^-1 D'P'e, J = P D, D = du/dtheta. Points err independently of each other, so that the
// covariance of P'e is the sum over points of P'E(ee')P: quadratic in u with the moments that add_point keeps as coefficients. E(P'e) is dP'dP u - dP'dQ.
// An elimination solves stage after stage: an error of what one found is one more error of the rows of the next.
#pragma once
#include <cmath>

#include "algest/arithmetic.hpp"
#include "algest/elimination.hpp"
#include "algest/packed.hpp"
#include "algest/point_noise.hpp"
#include "algest/triangle_update.hpp"

namespace algest {

namespace detail {

/// x <- (R'R)^-1 x. triangle: [R|z] packed. Cost: n (n+1).
template <class S>
inline void solve_normal(const S* triangle, int n, S* x) noexcept {
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < i; ++k) x[i] -= triangle[packed_index(n + 1, k, i)] * x[k];
        x[i] /= triangle[packed_index(n + 1, i, i)];
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k) x[i] -= triangle[packed_index(n + 1, i, k)] * x[k];
        x[i] /= triangle[packed_index(n + 1, i, i)];
    }
}

/// The sum over points of P'E(ee')P, n x n. u: of the columns, then -1 for the known side.
template <class S>
inline void covariance_of_errors(const PointRows& points, const S* moments, int n, const S* u, S* out) noexcept {
    for (int k = 0; k < n * n; ++k) out[k] = S(0);
    for (int r = 0; r < points.rows(); ++r) {
        for (int s = r; s < points.rows(); ++s) {
            for (int i = 0; i < points.width(r) - 1; ++i) {
                for (int j = r == s ? i : 0; j < points.width(s) - 1; ++j) {
                    S sum = S(0);
                    for (int a = 0; a < points.width(r); ++a) {
                        S inner = S(0);
                        for (int b = r == s ? a : 0; b < points.width(s); ++b) inner += (r == s && b > a ? S(2) : S(1)) * *moments++ * u[points.column(s, b)];
                        sum += inner * u[points.column(r, a)];
                    }
                    const int c = points.column(r, i);
                    const int d = points.column(s, j);
                    out[c * n + d] += sum;
                    if (r != s || i != j) out[d * n + c] += sum;
                }
            }
        }
    }
}
constexpr long covariance_of_errors_cost(const PointRows& points) noexcept {
    long out = 0;
    for (int r = 0; r < points.rows(); ++r) for (int s = r; s < points.rows(); ++s) out += entry_products(points, r, s) * (2L * change_products(points, r, s) + points.width(r));
    return out;
}

template <class S>
inline S power(S base, int exponent) noexcept {
    S out = S(1);
    for (int k = 0; k < exponent; ++k) out *= base;
    return out;
}

/// Columns at theta, and their slopes (columns x parameters), theta in the parameters' sizes.
template <class S>
inline void columns_at(const Elimination<S>& e, const S* theta, int columns, S* u, S* slopes) noexcept {
    for (int c = 0; c < columns; ++c) u[c] = S(0);
    for (int k = 0; k < columns * e.parameters; ++k) slopes[k] = S(0);
    for (const EliminationStage& s : e.stages) {
        for (int a = 0; a < s.alone; ++a) {
            const Alone<S>& alone = e.alone[s.first_alone + a];
            const int order = alone.squared != 0 ? 2 : 1;
            const S below = alone.coefficient * power(theta[alone.parameter], order - 1);
            u[s.first_column + a] = below * theta[alone.parameter];
            slopes[(s.first_column + a) * e.parameters + alone.parameter] = S(order) * below;
        }
        for (int k = s.first_summand; k < s.first_summand + s.summands; ++k) {
            const int column = s.first_column + e.column_of[k];
            const auto order = [&](int p) {   // of the parameter itself, where the table counts its square
                const bool squared = (p == s.x && (s.squares & 1U) != 0U) || (p == s.y && (s.squares & 2U) != 0U);
                return (squared ? 2 : 1) * e.exponents[k * e.parameters + p];
            };
            S value = e.coefficient_of[k];
            for (int p = 0; p < e.parameters; ++p) value *= power(theta[p], order(p));
            u[column] += value;
            for (int p = 0; p < e.parameters; ++p) {
                if (order(p) == 0) continue;
                S slope = e.coefficient_of[k] * S(order(p));
                for (int q = 0; q < e.parameters; ++q) slope *= power(theta[q], q == p ? order(q) - 1 : order(q));
                slopes[column * e.parameters + p] += slope;
            }
        }
    }
}

/// Writes the gain of one stage's parameters, by its normal equations: what they move with P'e of each column. slopes: as columns_at; changes: scratch, columns x
/// parameters. gain: parameters x columns, zero but for earlier stages.
template <class S>
inline void gain_of_stage(const Elimination<S>& e, const EliminationStage& s, const S* triangle, int columns, const S* slopes, S* changes, S* work, S* gain) noexcept {
    const int n = unknowns_of(s);
    const int p = e.parameters;
    S* const of_stage = work;
    S* const row = of_stage + triangle_scalars(n);
    const auto parameter = [&](int k) { return k < s.alone ? e.alone[s.first_alone + k].parameter : k == s.alone && s.x != no_parameter ? s.x : s.y; };
    for (int k = 0; k < triangle_scalars(n); ++k) of_stage[k] = S(0);
    for (int r = 0; r < s.columns; ++r) {
        for (int q = 0; q < p; ++q) {
            S sum = S(0);
            for (int c = r; c < s.columns; ++c) sum += triangle[packed_index(columns + 1, s.first_column + r, s.first_column + c)] * slopes[(s.first_column + c) * p + q];
            changes[r * p + q] = sum;
        }
        for (int k = 0; k < n; ++k) row[k] = changes[r * p + parameter(k)];
        row[n] = S(0);
        add_rows(of_stage, row, 1, n, S(1));
    }
    for (int c = 0; c < columns; ++c) {
        const bool inside = c >= s.first_column && c < s.first_column + s.columns;
        for (int k = 0; k < n; ++k) row[k] = inside ? slopes[c * p + parameter(k)] : S(0);
        for (int r = 0; r < s.columns; ++r) {
            S of_row = S(0);
            for (int q = 0; q < p; ++q) of_row += changes[r * p + q] * gain[q * columns + c];   // of earlier stages: the others are still zero
            for (int k = 0; k < n; ++k) row[k] -= changes[r * p + parameter(k)] * of_row;
        }
        solve_normal(of_stage, n, row);
        for (int k = 0; k < n; ++k) gain[parameter(k) * columns + c] = row[k];
    }
}

}  // namespace detail

/// Parameters whose covariance propagate_points gives.
template <class S>
constexpr int point_parameters(const Elimination<S>& e, int unknowns) noexcept { return e.parameters > 0 ? e.parameters : unknowns; }

/// Scalars of scratch that propagate_points needs.
template <class S>
constexpr int propagate_points_scratch(const Elimination<S>& e, int unknowns) noexcept {
    const int p = point_parameters(e, unknowns);
    return (unknowns + 1) + p + unknowns * unknowns + 2 * p * unknowns + (e.parameters > 0 ? 2 * unknowns * p + triangle_scalars(p) + p + 1 : 0);
}

/// Multiply-adds and divisions of propagate_points, about.
template <class S>
constexpr long propagate_points_cost(const PointRows& points, const Elimination<S>& e, int unknowns) noexcept {
    const long n = unknowns;
    const long p = point_parameters(e, unknowns);
    long gain = n * n * (n + 1);
    if (e.parameters > 0) {
        gain = p * (n + 1);
        for (int k = 0; k < e.stages.size; ++k) {
            const EliminationStage& s = e.stages[k];
            const int m = detail::unknowns_of(s);
            gain += s.summands * (p + 1) * (p + 2) + p * packed_size(s.columns) + add_rows_cost(s.columns, m) + n * (s.columns * (p + m) + m * (m + 1L));
        }
    }
    return detail::covariance_of_errors_cost(points) + gain + p * n * n + packed_size(static_cast<int>(p)) * (n + 1) + n * n + n + p * n;
}

/// Covariance (packed upper triangle) and, unless nullptr, bias of what was solved for: the unknowns, or with an elimination (parameters > 0) its
/// parameters. triangle, sums, moments: of all points; solution: ok, in the parameters' units. excess: times that the errors of the means are larger than
/// declared. The bias is the part that does not shrink with the number of points. Cost: propagate_points_cost. Never fails.
template <class S>
inline void propagate_points(const PointRows& points, const Elimination<S>& e, const S* triangle, const S* sums, const S* moments, int unknowns, S excess, const S* solution,
                             S* scratch, S* covariance, S* bias) noexcept {
    const int n = unknowns;
    const int p = point_parameters(e, unknowns);
    S* const u = scratch;
    S* const theta = u + n + 1;
    S* const of_errors = theta + p;
    S* const gain = of_errors + n * n;
    S* const half = gain + p * n;
    S* const slopes = half + p * n;
    for (int k = 0; k < p * n; ++k) gain[k] = S(0);
    u[n] = S(-1);
    if (e.parameters > 0) {
        for (int k = 0; k < p; ++k) theta[k] = solution[k] / e.sizes[k];
        detail::columns_at(e, theta, n, u, slopes);
        S* const changes = slopes + n * p;
        for (const EliminationStage& s : e.stages) detail::gain_of_stage(e, s, triangle, n, slopes, changes, changes + n * p, gain);
        for (int k = 0; k < p; ++k) for (int c = 0; c < n; ++c) gain[k * n + c] *= e.sizes[k];
    } else {
        for (int k = 0; k < n; ++k) u[k] = solution[k];
        for (int c = 0; c < n; ++c) {
            gain[c * n + c] = S(1);
            detail::solve_normal(triangle, n, gain + c * n);   // symmetric: a row is a column
        }
    }
    detail::covariance_of_errors(points, moments, n, u, of_errors);
    for (int k = 0; k < p; ++k) {
        for (int d = 0; d < n; ++d) {
            half[k * n + d] = S(0);
            for (int c = 0; c < n; ++c) half[k * n + d] += gain[k * n + c] * of_errors[c * n + d];
        }
    }
    int entry = 0;
    for (int k = 0; k < p; ++k) {
        for (int m = k; m < p; ++m, ++entry) {
            S sum = S(0);
            for (int c = 0; c < n; ++c) sum += half[k * n + c] * gain[m * n + c];
            covariance[entry] = m == k && sum < S(0) ? S(0) : excess * sum;   // a square that rounding has made negative
        }
    }
    if (bias == nullptr) return;
    for (int k = 0; k < p; ++k) bias[k] = S(0);
    for (int c = 0; c < n; ++c) {
        S mean = -sums[packed_size(n) + c];
        for (int d = 0; d < n; ++d) mean += sums[packed_index(n, c < d ? c : d, c < d ? d : c)] * u[d];
        mean *= excess;
        for (int k = 0; k < p; ++k) bias[k] -= mean * gain[k * n + c];
    }
}

}  // namespace algest
