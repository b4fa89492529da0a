// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/combinations.hpp"

#include <algorithm>

#include "generator/modular_ideal.hpp"

namespace algest::structure {

namespace {

using modular::Number;
using modular::Vector;

class Search {
public:
    Search(const std::vector<int>& open, std::size_t count, const modular::RowSpace& known, std::size_t columns, const Vector& point)
        : variables_(point.size()), count_(count), known_(known), columns_(columns), point_(point) {
        for (std::size_t k = 0; k < variables_; ++k) {
            Vector settled(columns);
            settled[k] = 1;
            if (std::find(open.begin(), open.end(), static_cast<int>(k)) == open.end()) independent_.add(settled);
        }
    }

    void of_two(int a, int b) {
        try_powers({{a, 1}, {b, 1}});
        try_powers({{b, 1}, {a, -1}});
        try_sum({{a, 1}, {b, 1}});
        try_sum({{a, 1}, {b, -1}});
    }
    void of_two_with_squares(int a, int b) {
        try_powers({{a, 1}, {b, 2}});
        try_powers({{a, 2}, {b, 1}});
        try_powers({{b, 1}, {a, -2}});
        try_powers({{b, 2}, {a, -1}});
    }
    void of_three(int a, int b, int c) {
        try_powers({{a, 1}, {b, 1}, {c, 1}});
        try_powers({{b, 1}, {c, 1}, {a, -1}});
        try_powers({{a, 1}, {c, 1}, {b, -1}});
        try_powers({{a, 1}, {b, 1}, {c, -1}});
        for (const int x : {1, -1}) for (const int y : {1, -1}) try_sum({{a, 1}, {b, x}, {c, y}});
    }
    void add(const Quotient& q) {
        if (found.size() == count_) return;
        const Vector slope = gradient(q);
        if (known_.contains(slope) && independent_.add(slope)) found.push_back(q);
    }

    std::vector<Quotient> found;

private:
    using Powers = std::vector<std::pair<int, int>>;   // parameter, power

    void try_powers(const Powers& powers) {
        Exponents above(variables_, 0);
        Exponents below(variables_, 0);
        for (const auto& [p, power] : powers) (power > 0 ? above : below)[static_cast<std::size_t>(p)] = std::abs(power);
        add({Polynomial{{above, 1}}, Polynomial{{below, 1}}});
    }

    void try_sum(const Powers& factors) {
        Polynomial out;
        for (const auto& [p, factor] : factors) {
            Exponents e(variables_, 0);
            e[static_cast<std::size_t>(p)] = 1;
            out.emplace(e, factor);
        }
        add({out, constant(1, variables_)});
    }

    Vector gradient(const Quotient& q) const {
        const Number above = modular::value_at(modular::from(q.numerator), point_);
        const Number below = modular::value_at(modular::from(q.denominator), point_);
        Vector out(columns_);
        for (std::size_t k = 0; k < variables_; ++k) {
            if (!uses(q.numerator, k) && !uses(q.denominator, k)) continue;
            const Number da = modular::value_at(modular::from(derivative(q.numerator, k)), point_);
            const Number db = modular::value_at(modular::from(derivative(q.denominator, k)), point_);
            out[k] = (da * below - above * db) / (below * below);
        }
        return out;
    }

    std::size_t variables_;
    std::size_t count_;
    const modular::RowSpace& known_;
    std::size_t columns_;
    const Vector& point_;
    modular::RowSpace independent_;
};

}  // namespace

std::vector<Quotient> combinations(const std::vector<int>& open, const std::vector<Quotient>& others, std::size_t count, const modular::RowSpace& known,
                                   std::size_t columns, const Vector& point) {
    Search search(open, count, known, columns, point);
    const auto each_pair = [&](auto use) {
        for (std::size_t a = 0; a < open.size(); ++a) for (std::size_t b = a + 1; b < open.size(); ++b) use(open[a], open[b]);
    };
    each_pair([&](int a, int b) { search.of_two(a, b); });
    each_pair([&](int a, int b) { search.of_two_with_squares(a, b); });
    for (std::size_t c = 0; c < open.size(); ++c) {
        for (std::size_t a = 0; a < c; ++a) for (std::size_t b = a + 1; b < c; ++b) search.of_three(open[a], open[b], open[c]);
    }
    for (const Quotient& q : others) search.add({cln::minusp(q.numerator.begin()->second) ? scaled(q.numerator, -1) : q.numerator, q.denominator});
    return search.found;
}

}  // namespace algest::structure
