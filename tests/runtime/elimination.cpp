// SPDX-License-Identifier: GPL-3.0-or-later
// Elimination by itself: when two answers fit equally well, and that the cost is the stated one whatever the data.
#include "tests/runtime/counted.hpp"

#include "algest/elimination.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "generated/pmsm_sensorless/pmsm_sensorless_tables.hpp"
#include "generated/pmsm_sensorless_voltage/pmsm_sensorless_voltage_tables.hpp"

using namespace algest;
using test::Counted;

namespace {

/// z = slope y + 3 y^2 at y = 1, 50 rows of different sizes: an elimination of one parameter.
template <class S>
struct Parabola {
    EliminationStage stage = {0, 2, 0, 0, 0, 2, no_parameter, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0};
    std::uint16_t column_of[2] = {0, 1};
    S coefficients[2] = {1, 1};
    std::uint8_t exponents[2] = {1, 2};
    S sizes[1] = {1};
    std::vector<S> triangle = std::vector<S>(static_cast<std::size_t>(triangle_scalars(2)), S(0));
    std::vector<Candidate<S>> candidates = std::vector<Candidate<S>>(10);
    CandidateList<S> list = {candidates.data(), 10, 0};
    S solution = 0;
    Solved<S> solved = {};

    explicit Parabola(double slope) {
        const Elimination<S> e = {1, {&stage, 1}, {nullptr, 0}, {column_of, 2}, {coefficients, 2}, {exponents, 2}, {nullptr, 0}, {nullptr, 0}, {sizes, 1}};
        for (int k = 0; k < 50; ++k) {
            S row[3] = {S(slope * (1 + 0.1 * (k % 3))), S(3 * (1 + 0.2 * (k % 5))), S(0)};
            row[2] = row[0] + row[1];
            add_rows(triangle.data(), row, 1, 2, S(1));
        }
        std::vector<S> scratch(static_cast<std::size_t>(elimination_scratch(e)));
        solved = eliminate(e, triangle.data(), 2, scratch.data(), &solution, {nullptr, S(0)}, &list);
    }
};

/// Tables with the counting scalar in place of double.
struct CountedTables {
    std::vector<Alone<Counted>> alone;
    std::vector<Counted> coefficients, terms, sizes;
    Elimination<Counted> elimination;

    explicit CountedTables(const Elimination<double>& from) {
        for (const Alone<double>& a : from.alone) alone.push_back({a.parameter, a.squared, a.coefficient});
        coefficients.assign(from.coefficient_of.begin(), from.coefficient_of.end());
        terms.assign(from.terms.begin(), from.terms.end());
        sizes.assign(from.sizes.begin(), from.sizes.end());
        const auto over = [](const auto& v) { return View<typename std::decay_t<decltype(v)>::value_type>{v.data(), static_cast<int>(v.size())}; };
        elimination = {from.parameters, from.stages, over(alone), from.column_of, over(coefficients), from.exponents, over(terms), from.factors, over(sizes)};
    }

    long counted(std::vector<Counted> triangle, int columns) const {
        std::vector<Counted> scratch(static_cast<std::size_t>(elimination_scratch(elimination, true)));
        std::vector<Counted> solution(static_cast<std::size_t>(elimination.parameters), Counted(0));
        Counted::operations = 0;
        std::vector<Counted> noise(static_cast<std::size_t>(point_noise_scalars(columns, elimination.stages.size)), Counted(1e-3));
        (void)eliminate(elimination, triangle.data(), columns, scratch.data(), solution.data(), {noise.data(), Counted(16)});
        return Counted::operations;
    }
};

std::string text_of(const std::string& path) {
    std::ifstream in(std::string(ALGEST_SOURCE) + "/" + path);
    std::stringstream out;
    out << in.rdbuf();
    return out.str();
}

}  // namespace

TEST_CASE("elimination: what tells two answers apart is not lost in the square of rounding") {
    // The other answer is near -1, where each residual is about 2 slope: far above rounding, 1e-7 and 2e-16 of 3, though its square is not.
    for (const double slope : {0.1, 0.03, 0.01, 3e-3}) {
        INFO("float, slope " << slope);
        const Parabola<float> p(slope);
        CHECK(p.solved.regular);
        CHECK(std::abs(p.solution - 1.0f) < 1e-6f);   // ten roundings
    }
    for (const double slope : {1e-5, 1e-6, 1e-7, 1e-8}) {
        INFO("double, slope " << slope);
        const Parabola<double> p(slope);
        CHECK(p.solved.regular);
        CHECK(std::abs(p.solution - 1.0) < 1e-14);
    }
}

TEST_CASE("elimination: what rounding alone tells apart is no answer") {
    CHECK_FALSE(Parabola<float>(0).solved.regular);
    CHECK_FALSE(Parabola<double>(0).solved.regular);
    CHECK_FALSE(Parabola<double>(1e-17).solved.regular);
    CHECK_FALSE(Parabola<float>(1e-9).solved.regular);
}

TEST_CASE("elimination: the cost does not depend on the data, and is the one in the header") {
    const auto check = [](const std::string& model, const Elimination<double>& tables) {
        INFO(model);
        const CountedTables counting(tables);
        const long stated = elimination_cost(tables, true);
        const int columns = 8;
        std::vector<std::vector<Counted>> all;
        all.emplace_back(static_cast<std::size_t>(triangle_scalars(columns)), Counted(0));
        all.emplace_back(static_cast<std::size_t>(triangle_scalars(columns)), Counted(std::numeric_limits<double>::quiet_NaN()));
        std::mt19937 bits(1);
        const auto number = [&] { return 2.0 * static_cast<double>(bits()) / 4294967295.0 - 1.0; };
        for (int n = 0; n < 300; ++n) {
            std::vector<Counted> triangle(static_cast<std::size_t>(triangle_scalars(columns)), Counted(0));
            for (int k = 0; k < 20; ++k) {
                std::vector<Counted> row(columns + 1);
                for (Counted& x : row) x = number() * std::pow(10.0, 2 * number());
                add_rows(triangle.data(), row.data(), 1, columns, Counted(1));
            }
            all.push_back(triangle);
        }
        long least = std::numeric_limits<long>::max(), most = 0;
        for (const std::vector<Counted>& triangle : all) {
            const long count = counting.counted(triangle, columns);
            least = std::min(least, count);
            most = std::max(most, count);
        }
        WARN(model << ": " << least << " to " << most << " multiply-adds and divisions, stated " << stated);
        CHECK(most <= stated);
        // What is not computed where a stage is singular or a place holds no root: the solve for the condition, and comparisons of candidates.
        CHECK(10 * least >= 9 * stated);
        CHECK(text_of("generated/" + model + "/" + model + ".hpp").find(" " + std::to_string(stated) + " multiply-adds and divisions at most") != std::string::npos);
    };
    check("pmsm_sensorless", generated::pmsm_sensorless_tables::blueprint.elimination);
    check("pmsm_sensorless_voltage", generated::pmsm_sensorless_voltage_tables::blueprint.elimination);
}

TEST_CASE("roots of polynomials cost what is stated, whatever the polynomial") {
    for (const int degree : {1, 3, 7}) {
        std::vector<Counted> scratch(static_cast<std::size_t>(real_roots_scratch(degree))), roots(static_cast<std::size_t>(root_places(degree))), real(roots.size());
        for (const double last : {0.0, 1.0, -1e-9, std::numeric_limits<double>::quiet_NaN()}) {
            std::vector<Counted> c(static_cast<std::size_t>(degree) + 1, Counted(last));
            c[0] = last < 0 ? 1 : last;
            Counted::operations = 0;
            real_roots(c.data(), degree, scratch.data(), roots.data(), real.data());
            CHECK(Counted::operations == real_roots_cost<double>(degree));
        }
    }
}
