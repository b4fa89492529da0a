// SPDX-License-Identifier: MIT-0
// Polynomials in two unknowns x and y as dense arrays: values, slopes, and the slopes of a sum of their squares.
#pragma once
#include <cmath>

#include "algest/polynomial_roots.hpp"

namespace algest {

/// Highest powers of x and of y.
struct PlaneDegrees {
    int x;
    int y;
};

/// Coefficients of a polynomial: of x^i y^j at plane_index.
constexpr int plane_size(PlaneDegrees d) noexcept { return (d.x + 1) * (d.y + 1); }
constexpr int plane_index(PlaneDegrees d, int i, int j) noexcept { return i * (d.y + 1) + j; }

/// Value and derivatives at a point, and what the first three are to be compared with: the sums of the sizes of their terms.
template <class S>
struct PlaneSlopes {
    S value, x, y, xx, xy, yy;
    S size, size_x, size_y;
};

/// Multiply-adds of plane_slopes.
constexpr long plane_slopes_cost(PlaneDegrees d) noexcept { return (d.x + 1L) * (5 * (d.y + 1L) + 9); }

/// Cost: plane_slopes_cost.
template <class S>
inline PlaneSlopes<S> plane_slopes(const S* p, PlaneDegrees d, S x, S y) noexcept {
    PlaneSlopes<S> out = {};
    for (int i = d.x; i >= 0; --i) {
        S value = S(0), by_y = S(0), by_yy = S(0), size = S(0), size_y = S(0);   // of the coefficient of x^i, a polynomial in y; by_yy is half
        for (int j = d.y; j >= 0; --j) {
            const S c = p[plane_index(d, i, j)];
            by_yy = by_yy * y + by_y;
            by_y = by_y * y + value;
            value = value * y + c;
            size_y = size_y * std::abs(y) + size;
            size = size * std::abs(y) + std::abs(c);
        }
        out.xx = out.xx * x + out.x;
        out.x = out.x * x + out.value;
        out.xy = out.xy * x + out.y;
        out.value = out.value * x + value;
        out.y = out.y * x + by_y;
        out.yy = out.yy * x + by_yy;
        out.size_x = out.size_x * std::abs(x) + out.size;
        out.size = out.size * std::abs(x) + size;
        out.size_y = out.size_y * std::abs(x) + size_y;
    }
    out.xx = out.xx + out.xx;
    out.yy = out.yy + out.yy;
    return out;
}

/// Multiply-adds of plane_value.
constexpr long plane_value_cost(PlaneDegrees d) noexcept { return (d.x + 1L) * (d.y + 1L); }

/// The value alone, by Horner's rule in x, its coefficients by Horner's rule in y. Cost: plane_value_cost.
template <class S>
inline S plane_value(const S* p, PlaneDegrees d, S x, S y) noexcept {
    S value = S(0);
    for (int i = d.x; i >= 0; --i) value = value * x + polynomial_value(p + plane_index(d, i, 0), d.y, y);
    return value;
}

/// The sum of squares of several polynomials, and half its derivatives; size_x and size_y: the sizes of the terms of x and y.
template <class S>
struct ErrorSlopes {
    S error, x, y, xx, xy, yy;
    S size_x, size_y;
};

/// Multiply-adds of error_slopes.
constexpr long error_slopes_cost(int count, PlaneDegrees d) noexcept { return count * (plane_slopes_cost(d) + 11); }

/// rows: `count` polynomials, one after the other. Cost: error_slopes_cost.
template <class S>
inline ErrorSlopes<S> error_slopes(const S* rows, int count, PlaneDegrees d, S x, S y) noexcept {
    ErrorSlopes<S> out = {};
    for (int r = 0; r < count; ++r) {
        const PlaneSlopes<S> p = plane_slopes(rows + r * plane_size(d), d, x, y);
        out.error += p.value * p.value;
        out.x += p.value * p.x;
        out.y += p.value * p.y;
        out.xx += p.x * p.x + p.value * p.xx;
        out.xy += p.x * p.y + p.value * p.xy;
        out.yy += p.y * p.y + p.value * p.yy;
        out.size_x += p.size * p.size_x;
        out.size_y += p.size * p.size_y;
    }
    return out;
}

/// Multiply-adds of add_product_with_slopes.
constexpr long product_with_slopes_cost(PlaneDegrees d) noexcept {
    const long size = plane_size(d);
    return size * (3 * size - (d.y + 1) - (d.x + 1));
}

/// Adds p dp/dx to by_x and p dp/dy to by_y, both of twice the degrees. Cost: product_with_slopes_cost.
template <class S>
inline void add_product_with_slopes(const S* p, PlaneDegrees d, S* by_x, S* by_y) noexcept {
    const PlaneDegrees twice = {2 * d.x, 2 * d.y};
    for (int i = 0; i <= d.x; ++i) {
        for (int j = 0; j <= d.y; ++j) {
            for (int k = 0; k <= d.x; ++k) {
                for (int l = 0; l <= d.y; ++l) {
                    const S product = p[plane_index(d, i, j)] * p[plane_index(d, k, l)];
                    if (k > 0) by_x[plane_index(twice, i + k - 1, j + l)] += S(k) * product;
                    if (l > 0) by_y[plane_index(twice, i + k, j + l - 1)] += S(l) * product;
                }
            }
        }
    }
}

/// Divides by the largest coefficient; leaves zeros and what is not finite as it is. Cost: size divisions.
template <class S>
inline void scale_to_one(S* p, int size) noexcept {
    S largest = S(0);
    for (int k = 0; k < size; ++k) largest = std::abs(p[k]) > largest ? S(std::abs(p[k])) : largest;
    const S divisor = largest > S(0) && std::isfinite(largest) ? largest : S(1);
    for (int k = 0; k < size; ++k) p[k] /= divisor;
}

}  // namespace algest
