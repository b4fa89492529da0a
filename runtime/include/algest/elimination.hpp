// SPDX-License-Identifier: MIT-0
// Least squares under polynomial constraints by elimination (Delpoux, Bodson, Floquet 2014, section 2.3 and appendix A): the rows are linear in
// columns that are polynomials of fewer parameters. Parameters that stand alone in a column drop out by the triangle; of the other one or two the
// extremum equations are polynomials, a precomputed resultant leaves one unknown, and all real candidates are tried.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "algest/arithmetic.hpp"
#include "algest/noise_gram.hpp"
#include "algest/packed.hpp"
#include "algest/plane_polynomial.hpp"
#include "algest/point_noise.hpp"
#include "algest/polynomial_roots.hpp"
#include "algest/triangle_update.hpp"
#include "algest/triangular.hpp"
#include "algest/view.hpp"

namespace algest {

constexpr std::uint16_t no_parameter = 0xFFFF;

/// A column that is coefficient * parameter, or coefficient * parameter^2, and no other column of its stage has that parameter.
template <class S>
struct Alone {
    std::uint16_t parameter;
    std::uint16_t squared;
    S coefficient;
};

/// Parameters that are solved for together; those of earlier stages are known. Its columns stand together in the triangle: first those alone, then
/// the ones of x and y, then those of known parameters.
struct EliminationStage {
    std::uint16_t first_column;
    std::uint16_t columns;
    std::uint16_t first_alone;
    std::uint16_t alone;
    std::uint16_t first_summand;
    std::uint16_t summands;
    std::uint16_t x;                ///< index of the parameter that the resultant eliminates; no_parameter: there is none
    std::uint16_t y;                ///< of the one that it leaves; no_parameter: all stand alone
    std::uint16_t squares;          ///< 1: x enters by its square alone, 2: y does
    std::uint16_t degree_x;         ///< of the columns in x (in x^2 where squared)
    std::uint16_t degree_y;
    std::uint16_t first_term;       ///< of the resultant
    std::uint16_t terms;
    std::uint16_t first_factor;
    std::uint16_t factors;          ///< of each term
    std::uint16_t resultant_degree; ///< in y
    std::uint16_t degree_of_first;  ///< of dE/dx in x
};

/// What columns mean, as data. Parameters are counted in their sizes: powers of two near what they are expected to be.
template <class S>
struct Elimination {
    int parameters;
    View<EliminationStage> stages;
    View<Alone<S>> alone;
    View<std::uint16_t> column_of;      ///< of each summand, within its stage
    View<S> coefficient_of;             ///< of each summand
    View<std::uint8_t> exponents;       ///< summands x parameters; of the square where a parameter is squared
    View<S> terms;                      ///< of the resultants: numbers, each times coefficients of the two extremum equations:
    View<std::uint8_t> factors;         ///< k: coefficient of x^k in dE/dx; degree_of_first + 1 + k: in dE/dy
    View<S> sizes;                      ///< of the parameters
};

/// What became of a candidate.
enum class Standing : std::uint8_t {
    best,       ///< satisfies every extremum equation, with the smallest error
    extremum,   ///< satisfies every extremum equation; another one has a smaller error
    unreal,     ///< a parameter would be the root of a negative number
    spurious    ///< a root of the resultant that does not satisfy every extremum equation
};

/// A real pair of roots. One that is no more than `kept_within` away from a common root of all extremum equations is that root.
template <class S>
struct Candidate {
    int stage;
    S x;         ///< in the parameters' sizes, of the square where squared
    S y;
    S error;     ///< sum of squared residuals, less what no value of these parameters changes
    Standing standing;
};

/// Where candidates are listed, if somebody asks: no more than `capacity` of them.
template <class S>
struct CandidateList {
    Candidate<S>* at;
    int capacity;
    int count;
};

/// What errors of the means make of operating points, as add_point sums it with the stages as groups, and how far the rows must stand above it; nullptr:
/// not asked. Then how many times the residuals are what these errors explain is written to `excess`.
template <class S>
struct NoiseMargin {
    const S* sums;
    S margin;
    S* excess = nullptr;
};

namespace detail {

/// Newton's method doubles the digits with every step: four bring the two digits of kept_within to sixteen; the others are for a root that the
/// resultant's rounding hid, farther away, and for a double root, which wins one bit a step.
constexpr int newton_steps = 12;
/// What the rounding of a resultant moves a root, at most. A double root moves by 1e-8 where the coefficients are good to epsilon of double; those of a
/// resultant are sums of products that cancel, and lose up to twelve digits of them before a root moves farther than this.
constexpr double kept_within = 1e-2;

constexpr int larger_of(int a, int b) noexcept { return a > b ? a : b; }
constexpr int unknowns_of(const EliminationStage& s) noexcept { return s.alone + (s.x != no_parameter ? 1 : 0) + (s.y != no_parameter ? 1 : 0); }
constexpr PlaneDegrees degrees_of(const EliminationStage& s) noexcept { return {s.degree_x, s.degree_y}; }
/// Degree of the polynomial in y whose roots are tried.
constexpr int degree_in_y(const EliminationStage& s) noexcept { return s.x != no_parameter ? s.resultant_degree : 2 * s.degree_y - 1; }

constexpr int stage_scratch(const EliminationStage& s) noexcept {
    const int n = unknowns_of(s);
    const int plane = plane_size(degrees_of(s));
    const int gradient = 2 * (2 * s.degree_x + 1) * (2 * s.degree_y + 1);
    const int degree = s.y == no_parameter ? 0 : degree_in_y(s);
    const int roots = 3 * (degree + 1) + real_roots_scratch(degree) + 2 * root_places(degree);
    const int inner = s.x == no_parameter ? 0 : (s.degree_of_first + 1) + real_roots_scratch(s.degree_of_first) + 2 * root_places(s.degree_of_first);
    const int judged = s.alone + triangle_scalars(n) + (n + 1) + solve_triangle_scratch(n) + n + 2 * s.columns * n;
    return s.summands + s.columns * plane + gradient + roots + inner + judged;
}

/// The residual of each row of the stage's triangle as a polynomial in x and y, columns that stand alone left out.
template <class S>
inline void residual_polynomials(const Elimination<S>& e, const EliminationStage& s, const S* triangle, int width, const S* parameters, S* values, S* rows) noexcept {
    const PlaneDegrees degrees = degrees_of(s);
    const int plane = plane_size(degrees);
    for (int k = 0; k < s.summands; ++k) {   // known parameters at their values
        const std::uint8_t* const exponents = e.exponents.data + (s.first_summand + k) * e.parameters;
        S value = e.coefficient_of[s.first_summand + k];
        for (int p = 0; p < e.parameters; ++p) {
            for (int power = 0; power < exponents[p] && p != s.x && p != s.y; ++power) value *= parameters[p];
        }
        values[k] = value;
    }
    for (int r = 0; r < s.columns; ++r) {
        S* const row = rows + r * plane;
        for (int k = 0; k < plane; ++k) row[k] = S(0);
        row[0] = -triangle[packed_index(width, s.first_column + r, width - 1)];
        for (int k = 0; k < s.summands; ++k) {
            const int column = e.column_of[s.first_summand + k];
            if (column < r) continue;
            const std::uint8_t* const exponents = e.exponents.data + (s.first_summand + k) * e.parameters;
            const int i = s.x == no_parameter ? 0 : exponents[s.x];
            const int j = s.y == no_parameter ? 0 : exponents[s.y];
            row[plane_index(degrees, i, j)] += triangle[packed_index(width, s.first_column + r, s.first_column + column)] * values[k];
        }
    }
}

/// What stands alone at a point, by back substitution. False where it is not finite.
template <class S>
inline bool alone_at(const Elimination<S>& e, const EliminationStage& s, const S* triangle, int width, const S* rows, S x, S y, S* alone) noexcept {
    for (int r = s.alone - 1; r >= 0; --r) {
        S sum = -plane_value(rows + r * plane_size(degrees_of(s)), degrees_of(s), x, y);
        for (int c = r + 1; c < s.alone; ++c) {
            sum -= triangle[packed_index(width, s.first_column + r, s.first_column + c)] * e.alone[s.first_alone + c].coefficient * alone[c];
        }
        alone[r] = sum / (triangle[packed_index(width, s.first_column + r, s.first_column + r)] * e.alone[s.first_alone + r].coefficient);
    }
    return all_finite(alone, s.alone);
}

/// True when every parameter that enters by its square has one.
template <class S>
inline bool real_at(const Elimination<S>& e, const EliminationStage& s, S x, S y, const S* alone) noexcept {
    bool real = ((s.squares & 1U) == 0U || x > S(0)) && ((s.squares & 2U) == 0U || y > S(0));
    for (int i = 0; i < s.alone; ++i) real = real && (e.alone[s.first_alone + i].squared == 0 || alone[i] > S(0));
    return real;
}

/// Half the error's derivatives by x and y as polynomials: of x^i y^j at [i * (2 degree_y + 1) + j]; each over its largest coefficient.
template <class S>
inline void extremum_equations(const EliminationStage& s, const S* rows, S* by_x, S* by_y) noexcept {
    const PlaneDegrees degrees = degrees_of(s);
    const PlaneDegrees twice = {2 * degrees.x, 2 * degrees.y};
    for (int k = 0; k < plane_size(twice); ++k) by_x[k] = by_y[k] = S(0);
    for (int r = s.alone; r < s.columns; ++r) add_product_with_slopes(rows + r * plane_size(degrees), degrees, by_x, by_y);
    scale_to_one(by_x, plane_size(twice));
    scale_to_one(by_y, plane_size(twice));
}

/// The polynomial in y whose roots are tried: the resultant of the extremum equations, or the only one of them.
template <class S>
inline void polynomial_in_y(const Elimination<S>& e, const EliminationStage& s, const S* by_x, const S* by_y, S* product, S* spare, S* out) noexcept {
    const int degree = degree_in_y(s);
    const int width = 2 * s.degree_y + 1;
    for (int k = 0; k <= degree; ++k) out[k] = s.x == no_parameter ? by_y[k] : S(0);
    for (int t = 0; t < s.terms; ++t) {
        for (int k = 0; k <= degree; ++k) product[k] = S(0);
        product[0] = e.terms[s.first_term + t];
        for (int f = 0; f < s.factors; ++f) {
            const int factor = e.factors[s.first_factor + t * s.factors + f];
            const bool first = factor <= s.degree_of_first;
            const S* const times = (first ? by_x : by_y) + (first ? factor : factor - s.degree_of_first - 1) * width;
            for (int k = 0; k <= degree; ++k) {
                S sum = S(0);
                for (int j = 0; j < width && j <= k; ++j) sum += times[j] * product[k - j];
                spare[k] = sum;
            }
            for (int k = 0; k <= degree; ++k) product[k] = spare[k];
        }
        for (int k = 0; k <= degree; ++k) out[k] += product[k];
    }
}

/// Newton's method on all extremum equations at once, from the residuals themselves, which squared coefficients would spoil. x, y: start, then
/// where it ends. False where it ends at no common root.
template <class S>
inline bool polish(const EliminationStage& s, const S* rows, S& x, S& y, S& error) noexcept {
    const PlaneDegrees degrees = degrees_of(s);
    ErrorSlopes<S> at = {};
    for (int step = 0; step <= newton_steps; ++step) {
        at = error_slopes(rows + s.alone * plane_size(degrees), s.columns - s.alone, degrees, x, y);
        if (step == newton_steps) break;
        const S xx = s.x == no_parameter ? S(1) : at.xx;
        const S determinant = xx * at.yy - at.xy * at.xy;
        x -= (at.yy * at.x - at.xy * at.y) / determinant;
        y -= (xx * at.y - at.xy * at.x) / determinant;
    }
    error = at.error;
    const S rounding = std::sqrt(std::numeric_limits<S>::epsilon());
    const S most_x = rounding * at.size_x;
    const S most_y = rounding * at.size_y;
    return std::isfinite(x) && std::isfinite(y) && std::isfinite(error) && std::abs(at.x) <= most_x && std::abs(at.y) <= most_y;
}

/// Lists a candidate unless one like it stands there; marks the former best where this one replaces it.
template <class S>
inline void list(CandidateList<S>* to, const Candidate<S>& candidate) noexcept {
    if (to == nullptr) return;
    const S same = std::sqrt(std::numeric_limits<S>::epsilon());
    for (int k = 0; k < to->count; ++k) {
        Candidate<S>& other = to->at[k];
        const bool both = (other.standing == Standing::spurious) == (candidate.standing == Standing::spurious);
        if (other.stage == candidate.stage && both && close(candidate.x, other.x, same) && close(candidate.y, other.y, same)) {
            if (candidate.standing != Standing::best) return;
            other.standing = Standing::extremum;   // replaced below by the same one, as the best
            other = to->at[--to->count];
            break;
        }
    }
    for (int k = 0; k < to->count && candidate.standing == Standing::best; ++k) {
        if (to->at[k].stage == candidate.stage && to->at[k].standing == Standing::best) to->at[k].standing = Standing::extremum;
    }
    if (to->count < to->capacity) to->at[to->count++] = candidate;
}

/// The best point of a stage so far, and the error of the next best one that is another point.
template <class S>
struct BestPoint {
    bool found;
    S x;
    S y;
    S error;
    S next;
};

template <class S>
inline void improve(BestPoint<S>& best, S x, S y, S error) noexcept {
    const S same = std::sqrt(std::numeric_limits<S>::epsilon());
    const bool other = !close(x, best.x, same) || !close(y, best.y, same);
    const bool better = !best.found || error < best.error;
    if (other && best.found) best.next = smaller(best.next, better ? best.error : error);
    if (better) {
        best.found = true;
        best.x = x;
        best.y = y;
        best.error = error;
    }
}

/// True when the rows fit two points equally well. The error is a sum of squares, and rounding moves its root, the length of the residuals, by a part
/// of that of the known side: each residual is summed of the summands times the triangle (two roundings each) and by Horner's rule (two a degree),
/// of epsilon/2 each; times 2 for the two points, and 8 for terms that are larger than the known side since they cancel.
template <class S>
inline bool is_tie(const EliminationStage& s, const S* rows, const BestPoint<S>& best) noexcept {
    S known = S(0);
    for (int r = s.alone; r < s.columns; ++r) known += rows[r * plane_size(degrees_of(s))] * rows[r * plane_size(degrees_of(s))];
    const S rounding = S(8 * 2 * (s.summands + s.degree_x + s.degree_y)) * std::numeric_limits<S>::epsilon();
    return std::sqrt(best.next) - std::sqrt(best.error) <= rounding * std::sqrt(known);
}

/// One stage while its candidates are tried.
template <class S>
struct Trial {
    const Elimination<S>& e;
    const EliminationStage& s;
    int stage;
    const S* triangle;
    int width;
    const S* rows;
    S* alone;
    CandidateList<S>* candidates;
    BestPoint<S> best;
};

/// Tries a pair of roots: what it is, and where Newton's method takes it, which may be a root that the resultant's rounding hid. A place without
/// a pair (there == false) is computed like the others, and changes nothing.
template <class S>
inline void try_pair(Trial<S>& t, S x, S y, bool there) noexcept {
    S at_x = x;
    S at_y = y;
    S error = S(0);
    const bool satisfied = polish(t.s, t.rows, at_x, at_y, error);
    const bool common = alone_at(t.e, t.s, t.triangle, t.width, t.rows, at_x, at_y, t.alone) && satisfied;
    if (!there) return;
    if (t.candidates != nullptr && (!common || !close(at_x, x, S(kept_within)) || !close(at_y, y, S(kept_within)))) {
        const S error_there = error_slopes(t.rows + t.s.alone * plane_size(degrees_of(t.s)), t.s.columns - t.s.alone, degrees_of(t.s), x, y).error;
        list(t.candidates, Candidate<S>{t.stage, x, y, error_there, Standing::spurious});
    }
    if (!common) return;
    if (!real_at(t.e, t.s, at_x, at_y, t.alone)) return list(t.candidates, Candidate<S>{t.stage, at_x, at_y, error, Standing::unreal});
    const bool better = !t.best.found || error < t.best.error;
    improve(t.best, at_x, at_y, error);
    list(t.candidates, Candidate<S>{t.stage, at_x, at_y, error, better ? Standing::best : Standing::extremum});
}

/// Tries every real root y of the resultant with every real root x of the first extremum equation there; as many places as there can be roots.
template <class S>
inline void try_all(Trial<S>& t, S* work) noexcept {
    const EliminationStage& s = t.s;
    const int degree = degree_in_y(s);
    const int width = 2 * s.degree_y + 1;
    S* const by_x = work;
    S* const by_y = by_x + (2 * s.degree_x + 1) * width;
    S* const in_y = by_y + (2 * s.degree_x + 1) * width;
    S* const product = in_y + degree + 1;
    S* const spare = product + degree + 1;
    S* const y = spare + degree + 1;
    S* const real_y = y + root_places(degree);
    S* const in_x = real_y + root_places(degree) + real_roots_scratch(degree);
    extremum_equations(s, t.rows, by_x, by_y);
    polynomial_in_y(t.e, s, by_x, by_y, product, spare, in_y);
    real_roots(in_y, degree, real_y + root_places(degree), y, real_y);
    for (int k = 0; k < root_places(degree); ++k) {
        if (s.x == no_parameter) {
            try_pair(t, S(0), y[k], real_y[k] > S(0));
            continue;
        }
        const int degree_x = s.degree_of_first;
        S* const x = in_x + degree_x + 1;
        S* const real_x = x + root_places(degree_x);
        for (int i = 0; i <= degree_x; ++i) in_x[i] = polynomial_value(by_x + i * width, width - 1, y[k]);
        real_roots(in_x, degree_x, real_x + root_places(degree_x), x, real_x);
        for (int i = 0; i < root_places(degree_x); ++i) {
            try_pair(t, x[i], y[k], real_y[k] > S(0) && real_x[i] > S(0));
        }
    }
}

/// How well the rows determine the parameters of the stage at a point: the condition of the residuals' derivatives, columns scaled.
template <class S>
inline Solved<S> condition_at(const Trial<S>& t, S x, S y, S* work) noexcept {
    const EliminationStage& s = t.s;
    const PlaneDegrees degrees = degrees_of(s);
    const int n = unknowns_of(s);
    S* const triangle = work;
    S* const row = triangle + triangle_scalars(n);
    S* const scratch = row + n + 1;
    S* const nothing = scratch + solve_triangle_scratch(n);
    for (int k = 0; k < triangle_scalars(n); ++k) triangle[k] = S(0);
    for (int r = 0; r < s.columns; ++r) {
        const PlaneSlopes<S> slopes = plane_slopes(t.rows + r * plane_size(degrees), degrees, x, y);
        int column = 0;
        for (; column < s.alone; ++column) {
            row[column] = column < r ? S(0) : t.triangle[packed_index(t.width, s.first_column + r, s.first_column + column)] * t.e.alone[s.first_alone + column].coefficient;
        }
        if (s.x != no_parameter) row[column++] = slopes.x;
        if (s.y != no_parameter) row[column++] = slopes.y;
        row[n] = S(0);
        add_rows(triangle, row, 1, n, S(1));
    }
    return solve_triangle(triangle, n, scratch, nothing);
}

/// What the columns of the stage do with its unknowns at a point: columns x unknowns_of(s), those alone first, then x and y. values: of
/// the summands, as residual_polynomials leaves them.
template <class S>
inline void column_slopes(const Trial<S>& t, const S* values, S x, S y, S* slopes) noexcept {
    const EliminationStage& s = t.s;
    const int n = unknowns_of(s);
    const auto power = [](S base, int exponent) {
        S out = S(1);
        for (int k = 0; k < exponent; ++k) out *= base;
        return out;
    };
    for (int k = 0; k < s.columns * n; ++k) slopes[k] = S(0);
    for (int a = 0; a < s.alone; ++a) slopes[a * n + a] = t.e.alone[s.first_alone + a].coefficient;
    for (int k = 0; k < s.summands; ++k) {
        const std::uint8_t* const exponents = t.e.exponents.data + (s.first_summand + k) * t.e.parameters;
        S* const slope = slopes + t.e.column_of[s.first_summand + k] * n + s.alone;
        const int i = s.x == no_parameter ? 0 : exponents[s.x];
        const int j = s.y == no_parameter ? 0 : exponents[s.y];
        if (i > 0) slope[0] += values[k] * S(i) * power(x, i - 1) * power(y, j);
        if (j > 0) slope[s.x == no_parameter ? 0 : 1] += values[k] * S(j) * power(x, i) * power(y, j - 1);
    }
}

/// Scalars that a stage leaves for the test against noise: the triangle of its J'J, then what noise makes of it.
constexpr int kept_of_stage(const EliminationStage& s) noexcept { return triangle_scalars(unknowns_of(s)) + unknowns_of(s) * unknowns_of(s); }

/// Keeps J'J of the stage, which condition_at left in work, and what noise makes of it: slopes' N slopes. values: of the summands.
template <class S>
inline void keep_for_noise(const Trial<S>& t, const S* sums, const S* values, S x, S y, S* work, S* kept) noexcept {
    const EliminationStage& s = t.s;
    const int n = unknowns_of(s);
    const int width = t.width - 1;
    S* const of_unknowns = kept + triangle_scalars(n);
    S* const slopes = work + triangle_scalars(n) + (n + 1) + solve_triangle_scratch(n) + n;
    S* const half = slopes + s.columns * n;   // N times the slopes
    for (int k = 0; k < triangle_scalars(n); ++k) kept[k] = work[k];
    column_slopes(t, values, x, y, slopes);
    for (int r = 0; r < s.columns; ++r) {
        for (int u = 0; u < n; ++u) {
            S sum = S(0);
            for (int c = 0; c < s.columns; ++c) sum += sums[packed_index(width, s.first_column + (r < c ? r : c), s.first_column + (r < c ? c : r))] * slopes[c * n + u];
            half[r * n + u] = sum;
        }
    }
    for (int u = 0; u < n; ++u) {
        for (int v = 0; v < n; ++v) {
            S sum = S(0);
            for (int r = 0; r < s.columns; ++r) sum += slopes[r * n + u] * half[r * n + v];
            of_unknowns[u * n + v] = sum;
        }
    }
}

/// The powers of x and y in a summand, at a point.
template <class S>
inline S powers_at(const EliminationStage& s, const std::uint8_t* exponents, S x, S y) noexcept {
    S out = S(1);
    for (int k = 0; s.x != no_parameter && k < exponents[s.x]; ++k) out *= x;
    for (int k = 0; s.y != no_parameter && k < exponents[s.y]; ++k) out *= y;
    return out;
}
constexpr long powers_at_cost(const EliminationStage& s, const std::uint8_t* exponents) noexcept {
    return (s.x != no_parameter ? exponents[s.x] : 0) + (s.y != no_parameter ? exponents[s.y] : 0);
}

/// The squared residuals that come of a parameter which an earlier stage found and which is off by 1/margin of itself: so much attenuation passes there.
template <class S>
inline S carried_residuals(const Trial<S>& t, const S* values, S x, S y, int parameter, S margin) noexcept {
    const EliminationStage& s = t.s;
    S out = S(0);
    if (parameter == s.x || parameter == s.y) return out;
    for (int r = s.alone; r < s.columns; ++r) {
        S change = S(0);
        for (int k = 0; k < s.summands; ++k) {
            const std::uint8_t* const exponents = t.e.exponents.data + (s.first_summand + k) * t.e.parameters;
            const int column = t.e.column_of[s.first_summand + k];
            if (exponents[parameter] == 0 || column < r) continue;
            change += t.triangle[packed_index(t.width, s.first_column + r, s.first_column + column)] * (S(exponents[parameter]) * values[k] * powers_at(s, exponents, x, y));
        }
        change /= margin;
        out += change * change;
    }
    return out;
}

template <class S>
constexpr long carried_residuals_cost(const Elimination<S>& e, const EliminationStage& s) noexcept {
    long out = 0;
    for (int p = 0; p < e.parameters; ++p) {
        if (p == s.x || p == s.y) continue;
        for (int r = s.alone; r < s.columns; ++r) {
            out += 2;
            for (int k = 0; k < s.summands; ++k) {
                const std::uint8_t* const exponents = e.exponents.data + (s.first_summand + k) * e.parameters;
                if (exponents[p] != 0 && e.column_of[s.first_summand + k] >= r) out += 3 + powers_at_cost(s, exponents);
            }
        }
    }
    return out;
}

/// How many times as large the residuals of the stage are as the errors of the means, and of what earlier stages found, explain. work: `columns` scalars.
template <class S>
inline S excess_of_stage(const Trial<S>& t, NoiseMargin<S> noise, const S* values, S x, S y, S* work) noexcept {
    const EliminationStage& s = t.s;
    S* const u = work;
    for (int c = 0; c < s.columns; ++c) u[c] = c < s.alone ? S(t.e.alone[s.first_alone + c].coefficient * t.alone[c]) : S(0);
    for (int k = 0; k < s.summands; ++k) {
        u[t.e.column_of[s.first_summand + k]] += values[k] * powers_at(s, t.e.exponents.data + (s.first_summand + k) * t.e.parameters, x, y);
    }
    S found = noise.sums[group_place(t.width - 1, t.stage) + 1];
    for (int r = s.alone; r < s.columns; ++r) {
        const S residual = plane_value(t.rows + r * plane_size(degrees_of(s)), degrees_of(s), x, y);
        found += residual * residual;
    }
    S expected = expected_residuals(noise.sums, t.width - 1, t.stage, s.first_column, s.columns, u);
    for (int p = 0; p < t.e.parameters; ++p) expected += carried_residuals(t, values, x, y, p, noise.margin);
    return residual_excess(found, expected);
}

/// Multiply-adds and divisions of the test against noise of one stage, at most.
template <class S>
constexpr long stage_above_noise_cost(const Elimination<S>& e, const EliminationStage& s) noexcept {
    const long n = unknowns_of(s);
    long slopes = 0;
    long powers = 0;
    for (int k = 0; k < s.summands; ++k) {
        const std::uint8_t* const exponents = e.exponents.data + (s.first_summand + k) * e.parameters;
        const int degree = (s.x == no_parameter ? 0 : exponents[s.x]) + (s.y == no_parameter ? 0 : exponents[s.y]);
        slopes += degree == 0 ? 0 : 2L * (degree + 2);
        powers += 1 + powers_at_cost(s, exponents);
    }
    const long excess = s.alone + powers + (s.columns - s.alone) * (plane_value_cost(degrees_of(s)) + 1) + expected_residuals_cost(s.columns) + carried_residuals_cost(e, s) + 1;
    return slopes + s.columns * s.columns * n + s.columns * n * n + triangle_rises_above_cost(unknowns_of(s)) + excess + 1;
}

/// Solves one stage; writes its parameters, in their sizes. kept: with a margin over noise, kept_of_stage scalars for its test.
template <class S>
inline Solved<S> solve_stage(const Elimination<S>& e, int stage, const S* triangle, int width, NoiseMargin<S> noise, S* scratch, S* kept, S* parameters,
                             CandidateList<S>* candidates) noexcept {
    const EliminationStage& s = e.stages[stage];
    const Solved<S> singular = {false, std::numeric_limits<S>::infinity()};
    S* const values = scratch;
    S* const rows = values + s.summands;
    S* const alone = rows + s.columns * plane_size(degrees_of(s));
    S* const work = alone + s.alone;
    residual_polynomials(e, s, triangle, width, parameters, values, rows);
    Trial<S> t = {e, s, stage, triangle, width, rows, alone, candidates, {s.y == no_parameter, S(0), S(0), S(0), std::numeric_limits<S>::infinity()}};
    if (s.y != no_parameter) try_all(t, work);
    const bool tie = s.y != no_parameter && is_tie(s, rows, t.best);
    const bool finite = alone_at(e, s, triangle, width, rows, t.best.x, t.best.y, alone);
    const bool answer = t.best.found && !tie && finite && real_at(e, s, t.best.x, t.best.y, alone);
    for (int i = 0; i < s.alone; ++i) parameters[e.alone[s.first_alone + i].parameter] = e.alone[s.first_alone + i].squared != 0 ? S(std::sqrt(alone[i])) : alone[i];
    if (s.x != no_parameter) parameters[s.x] = (s.squares & 1U) != 0U ? S(std::sqrt(t.best.x)) : t.best.x;
    if (s.y != no_parameter) parameters[s.y] = (s.squares & 2U) != 0U ? S(std::sqrt(t.best.y)) : t.best.y;
    const Solved<S> solved = condition_at(t, t.best.x, t.best.y, work);
    if (noise.sums != nullptr) {
        keep_for_noise(t, noise.sums, values, t.best.x, t.best.y, work, kept);
        *noise.excess = larger(*noise.excess, excess_of_stage(t, noise, values, t.best.x, t.best.y, work));
    }
    return answer ? solved : singular;
}

/// Multiply-adds and divisions of solve_stage, at most; products by zero are counted. above_noise: with a margin over noise.
template <class S>
constexpr long stage_cost(const Elimination<S>& e, int stage, bool above_noise) noexcept {
    const EliminationStage& s = e.stages[stage];
    const PlaneDegrees degrees = degrees_of(s);
    const int n = unknowns_of(s);
    long rows = 0;
    for (int k = 0; k < s.summands; ++k) {
        for (int p = 0; p < e.parameters; ++p) rows += p != s.x && p != s.y ? e.exponents[(s.first_summand + k) * e.parameters + p] : 0;
        rows += e.column_of[s.first_summand + k] + 1;
    }
    const long alone = s.alone * (plane_value_cost(degrees) + 2) + s.alone * (s.alone - 1L);
    const long tried = (newton_steps + 1) * error_slopes_cost(s.columns - s.alone, degrees) + newton_steps * 8L + 2 + alone + 2;   // the last two: improve
    const long condition = s.columns * plane_slopes_cost(degrees) + s.alone * (s.alone + 1L) / 2 + add_rows_cost(s.columns, n) + solve_triangle_cost(n) +
                           (above_noise ? stage_above_noise_cost(e, s) : 0);
    if (s.y == no_parameter) return rows + alone + condition;

    const int degree = degree_in_y(s);
    const int width = 2 * s.degree_y + 1;
    long product = 0;   // of polynomials in y
    for (int k = 0; k <= degree; ++k) product += k < width ? k + 1 : width;
    const long equations = (s.columns - s.alone) * product_with_slopes_cost(degrees) + 2L * (2 * s.degree_x + 1) * width + s.terms * (s.factors * product);
    const long for_x = s.x == no_parameter ? tried : (s.degree_of_first + 1L) * (width - 1) + real_roots_cost<S>(s.degree_of_first) + root_places(s.degree_of_first) * tried;
    const long tie = (s.columns - s.alone) + 2;
    return rows + equations + real_roots_cost<S>(degree) + root_places(degree) * for_x + tie + alone + condition;
}

}  // namespace detail

/// Scalars of scratch that eliminate needs. above_noise: with a margin over noise.
template <class S>
constexpr int elimination_scratch(const Elimination<S>& e, bool above_noise = false) noexcept {
    int most = 0;
    int kept = 0;
    for (int s = 0; s < e.stages.size; ++s) {
        most = detail::larger_of(most, detail::stage_scratch(e.stages[s]));
        kept += detail::kept_of_stage(e.stages[s]);
    }
    return most + (above_noise ? kept : 0);
}

/// Multiply-adds and divisions of eliminate without a list of candidates, at most: a solve that finds a stage singular early costs a few less.
template <class S>
constexpr long elimination_cost(const Elimination<S>& e, bool above_noise = false) noexcept {
    long out = e.parameters;
    for (int s = 0; s < e.stages.size; ++s) out += detail::stage_cost(e, s, above_noise);
    return out;
}

/// The parameters with the smallest sum of squares ||R u(theta) - z||^2, u the columns as polynomials; stage after stage. triangle: [R|z] packed, of
/// `columns` columns. solution: e.parameters entries, in their units. Condition: the worst of the stages'. On `regular == false`, which degenerate data
/// give, and data that fit no real parameters or two sets of them equally well, the solution is of no use. Limits of parameters do not count: the
/// smallest error wins, wherever it lies. Nor is it regular, though with a finite condition, where the rows of a stage do not rise above `noise` at its
/// solution; and where residuals are larger than noise explains, in whatever stage, noise counts as so much larger everywhere, for the means belong to all.
/// candidates: nullptr, or where those of the stages are listed, up to the first one without an answer.
/// Cost: elimination_cost. All places for roots are computed, whatever the data: Newton's steps dominate, D d (newton_steps + 1) rows of about
/// 8 plane_size multiply-adds for a resultant of degree D and a first extremum equation of degree d in x. Never fails, no allocation.
template <class S>
inline Solved<S> eliminate(const Elimination<S>& e, const S* triangle, int columns, S* scratch, S* solution, NoiseMargin<S> noise = {nullptr, S(0)},
                          CandidateList<S>* candidates = nullptr) noexcept {
    const Solved<S> singular = {false, std::numeric_limits<S>::infinity()};
    Solved<S> worst = {true, S(0)};
    S* const all_kept = scratch + elimination_scratch(e);
    S excess = S(1);
    const NoiseMargin<S> of_stages = {noise.sums, noise.margin, &excess};
    S* kept = all_kept;
    for (int s = 0; s < e.stages.size; ++s) {
        const Solved<S> solved = detail::solve_stage(e, s, triangle, columns + 1, of_stages, scratch, kept, solution, worst.regular ? candidates : nullptr);
        worst = {worst.regular && solved.regular, larger(worst.condition, solved.condition)};
        if (noise.sums != nullptr) kept += detail::kept_of_stage(e.stages[s]);
    }
    kept = all_kept;
    for (int s = 0; noise.sums != nullptr && s < e.stages.size; ++s) {
        const int n = detail::unknowns_of(e.stages[s]);
        const bool above = triangle_rises_above(kept, n, noise.margin * excess, kept + triangle_scalars(n));
        worst.regular = worst.regular && above;
        kept += detail::kept_of_stage(e.stages[s]);
    }
    if (noise.excess != nullptr) *noise.excess = excess;
    for (int p = 0; p < e.parameters; ++p) solution[p] *= e.sizes[p];
    return all_finite(solution, e.parameters) ? worst : singular;
}

}  // namespace algest
