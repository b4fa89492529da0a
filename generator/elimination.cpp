// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/elimination.hpp"

#include <ginac/ginac.h>

#include <algorithm>
#include <map>
#include <set>

#include "generator/ginac_exact.hpp"

namespace algest::elimination {

namespace {

using exact::Rational;

/// Powers of x and y that occur.
using Support = std::set<std::pair<int, int>>;

Support product(const Support& a, const Support& b) {
    Support out;
    for (const auto& [i, j] : a) for (const auto& [k, l] : b) out.insert({i + k, j + l});
    return out;
}

/// Of the derivative by x, or by y.
Support derivative(const Support& of, bool by_x) {
    Support out;
    for (const auto& [i, j] : of) if ((by_x ? i : j) > 0) out.insert({by_x ? i - 1 : i, by_x ? j : j - 1});
    return out;
}

/// The highest power of y beside each power of x; -1: that power of x does not occur.
std::vector<int> degrees_by_x(const Support& of) {
    std::vector<int> out;
    for (const auto& [i, j] : of) {
        out.resize(std::max(out.size(), static_cast<std::size_t>(i) + 1), -1);
        out[static_cast<std::size_t>(i)] = std::max(out[static_cast<std::size_t>(i)], j);
    }
    return out;
}

std::vector<bool> occurring(const std::vector<int>& degrees) {
    std::vector<bool> out;
    for (const int d : degrees) out.push_back(d >= 0);
    return out;
}

/// The resultant that leaves y, its terms as products of coefficients.
struct Elimination {
    std::vector<plan::EliminationTerm> terms;
    int degree;
    int degree_of_first;
    int degree_of_second;
};

/// columns: powers of (x, y) in them. Nullopt where the degrees are too high.
std::optional<Elimination> eliminate_first(const Support& columns) {
    Support with_known = columns;
    with_known.insert({0, 0});
    const Support error = product(with_known, with_known);
    const std::vector<int> first = degrees_by_x(derivative(error, true));
    const std::vector<int> second = degrees_by_x(derivative(error, false));
    if (static_cast<int>(first.size() + second.size()) - 2 > largest_degrees) return std::nullopt;
    Elimination out{{}, 0, static_cast<int>(first.size()) - 1, static_cast<int>(second.size()) - 1};
    for (const auto& [exponents, coefficient] : resultant(occurring(first), occurring(second))) {
        plan::EliminationTerm term{exact::nearest(coefficient, plan::Scalar::float64), {}};
        int degree = 0;
        for (std::size_t f = 0; f < exponents.size(); ++f) {
            for (int k = 0; k < exponents[f]; ++k) term.factors.push_back(static_cast<int>(f));
            degree += exponents[f] * (f < first.size() ? first[f] : second[f - first.size()]);
        }
        out.degree = std::max(out.degree, degree);
        out.terms.push_back(std::move(term));
    }
    return out;
}

class Sorter {
public:
    Sorter(const std::vector<Polynomial>& columns, const std::vector<bool>& unknown, const std::vector<Rational>& sizes)
        : columns_(columns), unknown_(unknown), sizes_(sizes), squared_(unknown.size(), false) {}

    Outcome run() {
        for (std::size_t p = 0; p < unknown_.size(); ++p) squared_[p] = unknown_[p] && even_everywhere(p);
        alone();
        std::vector<int> rest;
        for (std::size_t p = 0; p < unknown_.size(); ++p) {
            if (unknown_[p] && used(p) && std::count(alone_.begin(), alone_.end(), static_cast<int>(p)) == 0) rest.push_back(static_cast<int>(p));
        }
        out_.too_high = false;
        if (rest.size() > 2) {
            out_.too_many = rest;
            return out_;
        }
        order();
        choose(rest);
        summands();
        return out_;
    }

private:
    bool used(std::size_t p) const {
        return std::any_of(columns_.begin(), columns_.end(), [&](const Polynomial& c) { return uses(c, p); });
    }

    bool even_everywhere(std::size_t p) const {
        for (const Polynomial& c : columns_) for (const auto& [exponents, coefficient] : c) if (exponents[p] % 2 != 0) return false;
        return used(p);
    }

    int power(const Exponents& exponents, std::size_t p) const { return squared_[p] ? exponents[p] / 2 : exponents[p]; }

    void alone() {
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            if (columns_[k].size() != 1) continue;
            const Exponents& exponents = columns_[k].begin()->first;
            const auto only = std::find_if(exponents.begin(), exponents.end(), [](int e) { return e != 0; });
            if (only == exponents.end()) continue;
            const std::size_t p = static_cast<std::size_t>(only - exponents.begin());
            const auto holders = std::count_if(columns_.begin(), columns_.end(), [&](const Polynomial& c) { return uses(c, p); });
            const bool others = std::any_of(only + 1, exponents.end(), [](int e) { return e != 0; });
            if (!unknown_[p] || others || holders != 1 || power(exponents, p) != 1) continue;
            alone_.push_back(static_cast<int>(p));
            out_.sorted.order.push_back(static_cast<int>(k));
            const Rational coefficient = columns_[k].begin()->second * exact::power(sizes_[p], exponents[p]);
            out_.sorted.stage.alone.push_back({static_cast<int>(p), squared_[p], exact::text(coefficient), 0});
        }
    }

    /// Behind those that stand alone first the columns of unknown parameters, then those of known ones.
    void order() {
        std::vector<int>& order = out_.sorted.order;
        const std::vector<int> first = order;
        for (const bool wanted : {true, false}) {
            for (std::size_t k = 0; k < columns_.size(); ++k) {
                if (std::count(first.begin(), first.end(), static_cast<int>(k)) > 0) continue;
                bool has_unknown = false;
                for (std::size_t p = 0; p < unknown_.size(); ++p) has_unknown = has_unknown || (unknown_[p] && uses(columns_[k], p));
                if (has_unknown == wanted) order.push_back(static_cast<int>(k));
            }
        }
    }

    Support support(int x, int y) const {
        Support out;
        for (const Polynomial& c : columns_) {
            for (const auto& [exponents, coefficient] : c) {
                const int i = x < 0 ? 0 : power(exponents, static_cast<std::size_t>(x));
                const int j = y < 0 ? 0 : power(exponents, static_cast<std::size_t>(y));
                if (i + j > 0) out.insert({i, j});
            }
        }
        return out;
    }

    /// Which of the two parameters the resultant leaves: that with fewer terms, then with the lower degree, then the first.
    void choose(const std::vector<int>& rest) {
        plan::EliminationStage& stage = out_.sorted.stage;
        stage.x = -1;
        stage.y = rest.empty() ? -1 : rest.back();
        stage.degree_of_first = stage.degree_of_second = stage.resultant_degree = 0;
        if (rest.size() == 2) {
            const auto forward = eliminate_first(support(rest[0], rest[1]));
            const auto backward = eliminate_first(support(rest[1], rest[0]));
            out_.too_high = !forward && !backward;
            if (out_.too_high) return;
            const auto cost = [](const Elimination& e) { return std::make_pair(e.terms.size(), e.degree); };
            const bool turned = !forward || (backward && cost(*backward) < cost(*forward));
            const Elimination& chosen = turned ? *backward : *forward;
            stage.x = turned ? rest[1] : rest[0];
            stage.y = turned ? rest[0] : rest[1];
            stage.resultant = chosen.terms;
            stage.resultant_degree = chosen.degree;
            stage.degree_of_first = chosen.degree_of_first;
            stage.degree_of_second = chosen.degree_of_second;
        }
        stage.x_squared = stage.x >= 0 && squared_[static_cast<std::size_t>(stage.x)];
        stage.y_squared = stage.y >= 0 && squared_[static_cast<std::size_t>(stage.y)];
        stage.degree_x = stage.degree_y = 0;
        for (const auto& [i, j] : support(stage.x, stage.y)) {
            stage.degree_x = std::max(stage.degree_x, i);
            stage.degree_y = std::max(stage.degree_y, j);
        }
    }

    void summands() {
        const std::vector<int>& order = out_.sorted.order;
        out_.sorted.stage.columns = static_cast<int>(order.size());
        for (std::size_t k = alone_.size(); k < order.size(); ++k) {
            for (const auto& [exponents, coefficient] : columns_[static_cast<std::size_t>(order[k])]) {
                Rational sized = coefficient;
                std::vector<int> powers;
                for (std::size_t p = 0; p < exponents.size(); ++p) {
                    sized = sized * exact::power(sizes_[p], exponents[p]);
                    powers.push_back(power(exponents, p));
                }
                out_.sorted.stage.summands.push_back({static_cast<int>(k), exact::text(sized), 0, powers});
            }
        }
    }

    const std::vector<Polynomial>& columns_;
    const std::vector<bool>& unknown_;
    const std::vector<Rational>& sizes_;
    std::vector<bool> squared_;
    std::vector<int> alone_;
    Outcome out_;
};

}  // namespace

Polynomial resultant(const std::vector<bool>& a, const std::vector<bool>& b) {
    const GiNaC::symbol x("x");
    std::vector<GiNaC::symbol> symbols;
    const auto polynomial = [&](const std::vector<bool>& occurs, const std::string& name) {
        GiNaC::ex out = 0;
        for (std::size_t k = 0; k < occurs.size(); ++k) {
            symbols.emplace_back(name + std::to_string(k));
            if (occurs[k]) out += symbols.back() * GiNaC::pow(x, static_cast<int>(k));
        }
        return out;
    };
    const GiNaC::ex first = polynomial(a, "a");
    const GiNaC::ex second = polynomial(b, "b");
    if (b.size() == 1) return to_polynomial(second, symbols);   // no x in it: the resultant is a power of it
    return to_polynomial(GiNaC::resultant(first, second, x).expand(), symbols);
}

Outcome sort_columns(const std::vector<Polynomial>& columns, const std::vector<bool>& unknown, const std::vector<Rational>& sizes) {
    return Sorter(columns, unknown, sizes).run();
}

}  // namespace algest::elimination
