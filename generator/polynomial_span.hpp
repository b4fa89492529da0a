// SPDX-License-Identifier: GPL-3.0-or-later
// Linear combinations of polynomials, exactly.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "generator/polynomial.hpp"

namespace algest {

/// A growing set of linearly independent polynomials, each remembered as a combination of given generators.
class Span {
public:
    /// Coefficients over the generators, and what is left.
    struct Reduced {
        Polynomial rest;
        std::vector<exact::Rational> over;
    };

    Reduced reduce(Polynomial p) const {
        Reduced out{{}, std::vector<exact::Rational>(generators_, 0)};
        for (const Row& row : rows_) {
            const auto found = p.find(row.reduced.begin()->first);
            if (found == p.end()) continue;
            const exact::Rational factor = found->second / row.reduced.begin()->second;
            p = sum(p, scaled(row.reduced, -factor));
            for (std::size_t g = 0; g < row.over.size(); ++g) out.over[g] = out.over[g] + factor * row.over[g];
        }
        out.rest = std::move(p);
        return out;
    }

    /// Adds the rest of a reduction as a new generator, which is rest / scale.
    void add(const Reduced& reduced, const exact::Rational& scale) {
        std::vector<exact::Rational> over(generators_ + 1, 0);
        over[generators_] = scale;
        rows_.push_back({reduced.rest, over});
        ++generators_;
    }

    /// p over the generators. What is left of it becomes one more, divided by its content, and is appended to `added`.
    std::vector<exact::Rational> express(const Polynomial& p, std::vector<Polynomial>& added) {
        Reduced reduced = reduce(p);
        if (reduced.rest.empty()) return reduced.over;
        const exact::Rational scale = content(reduced.rest);
        added.push_back(scaled(reduced.rest, 1 / scale));
        add(reduced, scale);
        reduced.over.push_back(scale);
        return reduced.over;
    }

    std::size_t generators() const { return generators_; }

private:
    struct Row {
        Polynomial reduced;
        std::vector<exact::Rational> over;
    };
    std::vector<Row> rows_;
    std::size_t generators_ = 0;
};

}  // namespace algest
